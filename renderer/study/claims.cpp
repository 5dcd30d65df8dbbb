#include "renderer/study/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderer/adaptive/run_lab.h"
#include "renderer/measure/energy.h"
#include "renderer/measure/error_curve.h"
#include "renderer/measure/top_share.h"
#include "renderer/study/scaled_radiance.h"

namespace quartet {
namespace {

/// A sample so much brighter than the truth of its pixel, and of the scene, is a firefly.
constexpr float firefly_ratio = 20.0f;
constexpr float firefly_floor = 1.0f;
constexpr int further_distance = 4;

std::size_t index_of(RegionId id) {
  return std::size_t(&region(id) - regions().data());
}

/// What radiance is multiplied with so that our luminance of it is the report's of what it was.
/// Contrast is a ratio within a channel and stays what it is; the divergences know nothing else of
/// a pixel than its luminance.
const glm::vec3 weighing =
    report_weights / glm::vec3(luminance(1.0f, 0.0f, 0.0f), luminance(0.0f, 1.0f, 0.0f),
                               luminance(0.0f, 0.0f, 1.0f));

/// Follows one run pass by pass and sees what the pass after a firefly does about it.
class FireflyWatch {
 public:
  FireflyWatch(const Lab& lab, const SampleSource& source, const RadianceImage& truth,
               const std::vector<RegionId>& regions)
      : lab_(lab), source_(source), truth_(truth), regions_(regions) {}

  /// After a pass that took `wanted`; the lane's plan is that of the next one.
  void look(const std::vector<std::uint16_t>& wanted) {
    const Lane& lane = lab_.lanes().front();
    std::vector<glm::vec3> samples;
    for (int y = further_distance; y < lab_.height() - further_distance; ++y) {
      for (int x = further_distance; x < lab_.width() - further_distance; ++x) {
        const std::size_t pixel = index(x, y);
        if (regions_[pixel] == RegionId::outlines || regions_[pixel] == RegionId::margin) {
          continue;  // an outline draws samples without any firefly
        }
        samples.resize(wanted[pixel]);
        const std::uint32_t first = lane.taken()[pixel] - wanted[pixel];
        if (lab_.store().partial()) {
          source_(x, y, first, samples);  // what was used may be forgotten already
        } else {
          lab_.store().read(pixel, first, samples);
        }
        const float limit =
            std::max(firefly_floor, firefly_ratio * luminance(truth_.pixels()[pixel]));
        if (std::ranges::any_of(samples,
                                [&](const glm::vec3& s) { return luminance(s) > limit; })) {
          add(x, y, lane.plan().wanted);
        }
      }
    }
  }

  FireflyResponse response() const {
    FireflyResponse mean = sum_;
    if (mean.fireflies > 0) {
      mean.nearby /= double(mean.fireflies);
      mean.further /= double(mean.fireflies);
    }
    return mean;
  }

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y) * std::size_t(lab_.width()) + std::size_t(x);
  }

  /// The mean of what is planned over the ring of pixels at a distance.
  double ring(int x, int y, int distance, const std::vector<std::uint16_t>& planned) const {
    double sum = 0.0;
    int count = 0;
    for (int dy = -distance; dy <= distance; ++dy) {
      for (int dx = -distance; dx <= distance; ++dx) {
        if (std::max(std::abs(dx), std::abs(dy)) == distance) {
          sum += planned[index(x + dx, y + dy)];
          ++count;
        }
      }
    }
    return sum / count;
  }

  void add(int x, int y, const std::vector<std::uint16_t>& planned) {
    ++sum_.fireflies;
    sum_.nearby += ring(x, y, 1, planned);
    sum_.further += ring(x, y, further_distance, planned);
  }

  const Lab& lab_;
  const SampleSource& source_;
  const RadianceImage& truth_;
  const std::vector<RegionId>& regions_;
  FireflyResponse sum_;
};

void measure_regions(const Lane& lane, const std::vector<RegionId>& region_of_pixel,
                     const std::vector<std::size_t>& pixels, ClaimRun& run) {
  std::vector<double> samples(regions().size(), 0.0);
  for (std::size_t i = 0; i < region_of_pixel.size(); ++i) {
    samples[index_of(region_of_pixel[i])] += double(lane.taken()[i]);
  }
  const double total = std::accumulate(samples.begin(), samples.end(), 0.0);
  const std::size_t margin = index_of(RegionId::margin);
  for (std::size_t r = 0; r < samples.size(); ++r) {
    run.spp.push_back(pixels[r] > 0 ? samples[r] / double(pixels[r])
                                    : std::numeric_limits<double>::quiet_NaN());
    run.share.push_back(samples[r] / total);
  }
  run.mean_spp = total / double(region_of_pixel.size());
  run.lit_spp = (total - samples[margin]) / double(region_of_pixel.size() - pixels[margin]);
}

/// Pearson's.
double correlation(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  const auto n = double(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

/// One seed's lab, which all runs share.
class ClaimLab {
 public:
  ClaimLab(const SampleWorld& world, std::uint64_t seed,
           const std::vector<RegionId>& region_of_pixel, std::stop_token stop)
      : world_(world),
        regions_(region_of_pixel),
        stop_(std::move(stop)),
        source_(scaled(world.source(seed), weighing)),
        weighed_truth_(scaled(*world.reference, weighing)),
        lab_(source_, world.width, world.height, std::span(&uniform_, 1),
             lab_options(world, seed)) {}

  bool run_criterion(EstimatorId id, std::uint32_t passes, const std::vector<std::size_t>& pixels,
                     ClaimRun& run) {
    lab_.set_settings(0, default_settings(id));
    FireflyWatch watch(lab_, source_, weighed_truth_, regions_);
    std::vector<std::uint16_t> wanted = lane().plan().wanted;
    const bool ended = run_lab(lab_, stop_, [&] {
      watch.look(wanted);
      wanted = lane().plan().wanted;
      return lane().pass() < passes;
    });
    if (!ended) {
      return false;
    }
    run.firefly = watch.response();
    run.seconds = lane().history().back().seconds;
    const RadianceImage picture = this->picture();
    run.relmse = error(MetricId::relmse, picture);
    run.relmse_top = relmse_top_share(picture, *world_.reference);
    run.flip = error(MetricId::flip, picture);
    run.energy = energy_error(picture, *world_.reference);
    measure_regions(lane(), regions_, pixels, run);
    return true;
  }

  /// What uniform sampling reaches in each run's time, between the passes around it.
  bool run_uniform(ClaimSeed& seed) {
    lab_.set_settings(0, uniform_);
    double longest = 0.0;
    for (const ClaimRun& run : seed.runs) {
      longest = std::max(longest, run.seconds);
    }
    std::vector<ErrorCurve::Point> relmse;
    std::vector<ErrorCurve::Point> flip;
    double before = 0.0;
    double first = 0.0;
    RadianceImage picture_before;
    const bool ended = run_lab(lab_, stop_, [&] {
      const double seconds = lane().history().back().seconds;
      first = before > 0.0 ? first : seconds;
      RadianceImage picture = this->picture();
      relmse.push_back({seconds, error(MetricId::relmse, picture)});
      // FLIP takes longer than a pass: only on both sides of where it is asked for.
      const bool is_asked = std::ranges::any_of(seed.runs, [&](const ClaimRun& run) {
        return run.seconds > before && run.seconds <= seconds;
      });
      if (is_asked && before > 0.0) {
        flip.push_back({before, error(MetricId::flip, picture_before)});
      }
      if (is_asked) {
        flip.push_back({seconds, error(MetricId::flip, picture)});
      }
      picture_before = std::move(picture);
      before = seconds;
      return seconds < longest;
    });
    if (!ended) {
      return false;
    }
    const ErrorCurve relmse_curve(std::move(relmse));
    const ErrorCurve flip_curve(std::move(flip));
    for (ClaimRun& run : seed.runs) {
      // A run that ends within uniform sampling's first pass is compared with that.
      run.uniform_relmse = relmse_curve.error_at(std::max(run.seconds, first));
      run.uniform_flip = flip_curve.error_at(std::max(run.seconds, first));
    }
    return true;
  }

  const Lane& lane() const { return lab_.lanes().front(); }
  bool partial() const { return lab_.partial(); }

 private:
  /// As it is without the weights.
  RadianceImage picture() const { return scaled(lane().film().image(), 1.0f / weighing); }

  double error(MetricId id, const RadianceImage& picture) const {
    return metric(id).compute(picture, *world_.reference);
  }

  const SampleWorld& world_;
  const std::vector<RegionId>& regions_;
  const std::stop_token stop_;
  const SampleSource source_;
  const RadianceImage weighed_truth_;
  const LaneSettings uniform_ = default_settings(EstimatorId::uniform);
  Lab lab_;
};

}  // namespace

std::optional<ClaimData> measure_claims(
    const SampleWorld& world, const std::vector<RegionId>& region_of_pixel, std::uint32_t passes,
    std::uint32_t seeds, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress) {
  ClaimData data;
  data.pixels.assign(regions().size(), 0);
  for (const RegionId id : region_of_pixel) {
    ++data.pixels[index_of(id)];
  }
  constexpr std::size_t steps = report_criterion_count + 1;
  for (std::uint32_t k = 0; k < seeds; ++k) {
    const std::uint64_t seed = world.first_seed + k;
    ClaimLab lab(world, seed, region_of_pixel, stop);
    ClaimSeed measured;
    std::vector<std::vector<std::uint32_t>> maps;
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      progress(double(std::size_t(k) * steps + c) / double(std::size_t(seeds) * steps),
               fmt::format("seed {}, {}", seed, estimator(report_criteria[c]).id));
      if (!lab.run_criterion(report_criteria[c], passes, data.pixels, measured.runs[c])) {
        return std::nullopt;
      }
      keep_most(data.rejected, rejected_of(lab.lane(), seed));
      maps.emplace_back(lab.lane().taken().begin(), lab.lane().taken().end());
    }
    if (!lab.run_uniform(measured)) {
      return std::nullopt;
    }
    data.partial |= lab.partial();
    // The first criterion is contrast, the others are the divergences.
    measured.lowest_correlation =
        std::min({correlation(maps[1], maps[2]), correlation(maps[1], maps[3]),
                  correlation(maps[2], maps[3])});
    measured.highest_with_contrast =
        std::max({correlation(maps[0], maps[1]), correlation(maps[0], maps[2]),
                  correlation(maps[0], maps[3])});
    data.seeds.push_back(std::move(measured));
  }
  return data;
}

Interval over_seeds(const ClaimData& data, const std::function<double(const ClaimSeed&)>& value,
                    double p) {
  std::vector<double> values;
  values.reserve(data.seeds.size());
  for (const ClaimSeed& seed : data.seeds) {
    values.push_back(value(seed));
  }
  return mean_interval(values, p);
}

Interval against_uniform(const ClaimData& data, std::size_t criterion, MetricId metric) {
  const Interval logarithm = over_seeds(data, [&](const ClaimSeed& seed) {
    const ClaimRun& run = seed.runs[criterion];
    return metric == MetricId::flip ? std::log(run.flip / run.uniform_flip)
                                    : std::log(run.relmse / run.uniform_relmse);
  });
  return {std::exp(logarithm.mean), std::exp(logarithm.low), std::exp(logarithm.high)};
}

}  // namespace quartet
