#include "renderer/adaptive/film/film.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <type_traits>

#include "renderer/adaptive/estimators/spread.h"

namespace quartet {
namespace {

/// In double: the spread of nearly equal samples is smaller than what single precision rounds.
double exact_luminance(const glm::vec3& c) {
  return luminance(double(c.r), double(c.g), double(c.b));
}

/// Zeros, or no memory.
template <class T>
void allocate(std::vector<T>& plane, std::size_t pixels, bool wanted) {
  if (wanted) {
    plane.assign(pixels, T{});
  } else {
    std::vector<T>().swap(plane);
  }
}

}  // namespace

bool is_in_half(SampleHalf half, std::uint32_t index) {
  switch (half) {
    case SampleHalf::none:
      break;
    case SampleHalf::alternate:
      return index % 2 == 0;
    case SampleHalf::class_a:
      return std::popcount(index & 0xaaaaaaaau) % 2 == 1;
  }
  return false;
}

FilmStatistics operator|(const FilmStatistics& a, const FilmStatistics& b) {
  assert(a.half == SampleHalf::none || b.half == SampleHalf::none || a.half == b.half);
  FilmStatistics both;
  both.variance = a.variance || b.variance;
  both.chi2 = a.chi2 || b.chi2;
  both.kl = a.kl || b.kl;
  both.hellinger = a.hellinger || b.hellinger;
  both.half = a.half != SampleHalf::none ? a.half : b.half;
  both.replicated = a.replicated || b.replicated;
  both.clamp = std::min(a.clamp, b.clamp);
  return both;
}

Film::Film(int width, int height, FilmStatistics statistics)
    : width_(width), height_(height), statistics_(statistics) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  for (std::vector<float>& plane : means_) {
    plane.assign(pixels, 0.0f);
  }
  counts_.assign(pixels, 0);
  rejected_.assign(pixels, 0);
  allocate_statistics();
}

/// Zeros for what is asked for, no memory for what is not.
void Film::allocate_statistics() {
  const FilmStatistics& keep = statistics_;
  allocate(deviations_, size(), keep.variance);
  allocate(spreads_[std::size_t(Divergence::chi2)], size(), keep.chi2);
  allocate(spreads_[std::size_t(Divergence::kl)], size(), keep.kl);
  allocate(spreads_[std::size_t(Divergence::hellinger)], size(), keep.hellinger);
  allocate(luminances_, size(), keep.chi2 || keep.kl || keep.hellinger);
  allocate(halves_, size(), keep.half != SampleHalf::none);
  allocate(replicates_, size(), keep.replicated && (keep.variance || keep.chi2));
  allocate(seen_above_, size(), keep.clamps());
}

void Film::add(std::size_t pixel, std::span<const glm::vec3> samples) {
  keep_sums();
  RunningMean running{sums_[pixel], counts_[pixel]};
  std::uint32_t index = counts_[pixel] + rejected_[pixel];
  for (const glm::vec3& taken : samples) {
    const std::uint32_t i = index++;
    if (!acceptable(taken)) {
      ++rejected_[pixel];
      continue;
    }
    const glm::vec3 sample = seen_above_.empty() ? taken : clamped(pixel, taken, running);
    if (statistics_.variance && running.count > 0) {
      // Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products",
      // Technometrics 4(3), 1962, in the form that needs only the sum so far.
      const double n = double(running.count);
      const glm::dvec3 d = n * glm::dvec3(sample) - running.sum;
      deviations_[pixel] += d * d * (1.0 / (n * (n + 1.0)));
    }
    if (!luminances_.empty()) {
      add_luminance(pixel, double(running.count), exact_luminance(sample));
    }
    if (!halves_.empty() && is_in_half(statistics_.half, i)) {
      halves_[pixel].add(sample);
    }
    if (!replicates_.empty()) {
      replicates_[pixel].add(i, glm::dvec3(sample));
    }
    running.add(sample);
  }
  sums_[pixel] = running.sum;
  put(pixel, running.count, running.mean());
}

/// A sample as it enters. Where the first one was above the clamp, which may be a light, and the
/// second is not, the first is cut too, afterwards.
glm::vec3 Film::clamped(std::size_t pixel, const glm::vec3& sample, RunningMean& running) {
  SeenAbove& seen = seen_above_[pixel];
  const bool is_above = std::max({sample.x, sample.y, sample.z}) > statistics_.clamp;
  if (running.count == 0) {
    seen = is_above ? SeenAbove::first : SeenAbove::nothing;
    return sample;
  }
  if (running.count == 1 && seen == SeenAbove::first) {
    seen = is_above ? SeenAbove::light : SeenAbove::nothing;
    if (!is_above) {
      running.sum = min(running.sum, glm::dvec3(double(statistics_.clamp)));
      if (!replicates_.empty()) {
        replicates_[pixel].cut(double(statistics_.clamp));
      }
    }
  }
  return seen == SeenAbove::light ? sample : min(sample, glm::vec3(statistics_.clamp));
}

/// One more luminance, after `count` of them.
void Film::add_luminance(std::size_t pixel, double count, double luminance) {
  double& mean = luminances_[pixel];
  if (count == 0.0) {
    mean = luminance;
    return;
  }
  // Not from a sum: that of equal values is rounded, and they would seem to differ.
  const double moved = mean + (luminance - mean) / (count + 1.0);
  const auto add = [&]<Divergence divergence>(std::integral_constant<Divergence, divergence>) {
    std::vector<double>& spreads = spreads_[std::size_t(divergence)];
    if (!spreads.empty()) {
      spreads[pixel] += spread_step<divergence>(count, mean, luminance, moved);
    }
  };
  add(std::integral_constant<Divergence, Divergence::chi2>());
  add(std::integral_constant<Divergence, Divergence::kl>());
  add(std::integral_constant<Divergence, Divergence::hellinger>());
  mean = moved;
}

void Film::put_row(std::size_t first, std::span<const std::uint32_t> counts, const MeanRow& means) {
  std::ranges::copy(counts, counts_.data() + first);
  for (std::size_t c = 0; c < means.size(); ++c) {
    std::copy_n(means[c], counts.size(), means_[c].data() + first);
  }
}

std::uint32_t Film::reject(std::size_t pixel, std::span<const glm::vec3> samples) {
  const auto bad = std::uint32_t(std::count_if(
      samples.begin(), samples.end(), [](const glm::vec3& sample) { return !acceptable(sample); }));
  rejected_[pixel] += bad;
  return bad;
}

void Film::keep_sums() {
  if (sums_.empty()) {
    sums_.assign(size(), glm::dvec3(0.0));
  }
}

void Film::restore_sum(std::size_t pixel, std::span<const glm::vec3> samples) {
  RunningMean running;
  for (const glm::vec3& sample : samples) {
    if (acceptable(sample)) {
      running.add(sample);
    }
  }
  assert(running.count == counts_[pixel]);
  sums_[pixel] = running.sum;
}

void Film::restart(FilmStatistics statistics) {
  statistics_ = statistics;
  for (std::vector<float>& plane : means_) {
    std::fill(plane.begin(), plane.end(), 0.0f);
  }
  std::fill(counts_.begin(), counts_.end(), 0u);
  std::fill(rejected_.begin(), rejected_.end(), 0u);
  sums_.clear();
  allocate_statistics();
}

std::uint64_t Film::total_rejected() const {
  return std::accumulate(rejected_.begin(), rejected_.end(), std::uint64_t(0));
}

glm::dvec3 Film::variance_of_mean(std::size_t pixel) const {
  assert(statistics_.variance);
  if (statistics_.replicated) {
    return quartet::variance_of_mean(replicates_[pixel]).channels;
  }
  const double n = counts_[pixel];
  return n < 2.0 ? glm::dvec3(0.0) : deviations_[pixel] / ((n - 1.0) * n);
}

LuminanceDeviations Film::luminance_deviations(std::size_t pixel) const {
  assert(statistics_.chi2);
  const std::uint32_t n = counts_[pixel];
  if (n < 2) {
    return {};
  }
  if (statistics_.replicated) {
    const MeanVariance variance = quartet::variance_of_mean(replicates_[pixel]);
    return {variance.luminance * variance.freedom * n, variance.freedom};
  }
  return {spread(Divergence::chi2, pixel), n - 1};
}

RadianceImage Film::image() const {
  RadianceImage image(width_, height_);
  for (std::size_t i = 0; i < size(); ++i) {
    image.pixels()[i] = {means_[0][i], means_[1][i], means_[2][i]};
  }
  return image;
}

std::size_t Film::bytes() const {
  constexpr std::size_t per_pixel = 3 * sizeof(float) + 2 * sizeof(std::uint32_t);
  std::size_t doubles = luminances_.size();
  for (const std::vector<double>& plane : spreads_) {
    doubles += plane.size();
  }
  return size() * per_pixel + (sums_.size() + deviations_.size()) * sizeof(glm::dvec3) +
         doubles * sizeof(double) + halves_.size() * sizeof(RunningMean) +
         replicates_.size() * sizeof(Replicates) + seen_above_.size();
}

}  // namespace quartet
