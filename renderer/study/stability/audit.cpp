#include "renderer/study/stability/audit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/base/math/lot.h"
#include "renderer/base/parallel.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {
namespace {

/// Welford 1962, without what no film would take.
void look(const SampleSource& hidden, int x, int y, std::uint32_t samples, Audit::Pixel& pixel) {
  std::vector<glm::vec3> radiance(samples);
  hidden(x, y, 0, radiance);
  glm::dvec3 squares(0.0);
  double count = 0.0;
  for (const glm::vec3& sample : radiance) {
    if (acceptable(sample)) {
      count += 1.0;
      const glm::dvec3 delta = glm::dvec3(sample) - pixel.mean;
      pixel.mean += delta / count;
      squares += delta * (glm::dvec3(sample) - pixel.mean);
    }
  }
  pixel.variance_of_mean = count > 1.0 ? squares / (count * (count - 1.0)) : glm::dvec3(0.0);
}

}  // namespace

Audit::Audit(const SampleSource& hidden, int width, int height, double share, std::uint32_t samples,
             std::uint64_t seed) {
  const std::size_t all = std::size_t(width) * std::size_t(height);
  for (std::size_t pixel = 0; pixel < all; ++pixel) {
    if (lot(pixel, seed) < share) {
      pixels_.push_back({pixel, glm::dvec3(0.0), glm::dvec3(0.0)});
    }
  }
  parallel_for(pixels_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto place = int(pixels_[i].pixel);
      look(hidden, place % width, place / width, samples, pixels_[i]);
    }
  });
}

std::vector<Audit::Look> Audit::check(std::span<const PixelState> states,
                                      const std::array<std::span<const float>, 3>& means,
                                      double target) const {
  constexpr double relative_floor = 0.01;  // as in relmse
  std::vector<Look> looks;
  for (const Pixel& audited : pixels_) {
    if (states[audited.pixel] != PixelState::done) {
      continue;
    }
    double error = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double off = double(means[std::size_t(c)][audited.pixel]) - audited.mean[c];
      error += (off * off - audited.variance_of_mean[c]) /
               (audited.mean[c] * audited.mean[c] + relative_floor) / 3.0;
    }
    looks.push_back({audited.pixel, error > target});
  }
  return looks;
}

Interval wrong_share_interval(std::span<const Audit::Look> looks, double p) {
  struct Cluster {
    double looks = 0.0;
    double wrong = 0.0;
  };
  std::map<std::size_t, Cluster> pixels;
  Cluster all;
  for (const Audit::Look& look : looks) {
    for (Cluster* cluster : {&pixels[look.pixel], &all}) {
      cluster->looks += 1.0;
      cluster->wrong += look.wrong ? 1.0 : 0.0;
    }
  }
  if (pixels.empty()) {
    return share_interval(0.0, 0.0, p);
  }
  const auto count = double(pixels.size());
  const double share = all.wrong / all.looks;
  double squares = 0.0;
  for (const auto& [pixel, cluster] : pixels) {
    const double off = cluster.wrong - share * cluster.looks;
    squares += off * off;
  }
  const double variance = squares / (all.looks * all.looks) * count / std::max(count - 1.0, 1.0);
  // Where all looks say the same, nothing is known of how runs at one pixel are related: then they
  // count as one.
  const double independent =
      variance > 0.0 ? std::min(share * (1.0 - share) / variance, all.looks) : count;
  return share_interval(share * independent, independent, p);
}

}  // namespace quartet
