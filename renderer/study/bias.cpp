#include "renderer/study/bias.h"
#include "renderer/adaptive/effort.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/adaptive/run_lab.h"
#include "renderer/base/interval.h"
#include "renderer/base/parallel.h"
#include "renderer/measure/energy.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {
namespace {

/// Pictures of the first n samples of every pixel, for several n.
using Uniform = std::map<std::uint32_t, RadianceImage>;

void make_uniform(const SampleSource& source, Uniform& pictures) {
  const RadianceImage& any = pictures.begin()->second;
  const int width = any.width();
  const std::uint32_t most = pictures.rbegin()->first;
  parallel_for(any.size(), 64, [&](std::size_t begin, std::size_t end) {
    std::vector<glm::vec3> samples(most);
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      source(int(pixel) % width, int(pixel) / width, 0, samples);
      RunningMean mean;
      std::uint32_t taken = 0;
      for (auto& [count, picture] : pictures) {
        for (; taken < count; ++taken) {
          if (acceptable(samples[taken])) {
            mean.add(samples[taken]);
          }
        }
        picture.pixels()[pixel] = mean.mean();
      }
    }
  });
}

/// Sums over the seeds so far.
struct Sums {
  std::vector<glm::dvec3> shown, shown_squares, uniform;
  std::vector<double> difference, difference_squares;

  explicit Sums(std::size_t pixels)
      : shown(pixels, glm::dvec3(0.0)),
        shown_squares(shown),
        uniform(shown),
        difference(pixels, 0.0),
        difference_squares(difference) {}

  void add(const RadianceImage& picture, const RadianceImage& other) {
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const glm::dvec3 x(picture.pixels()[i]);
      const glm::dvec3 u(other.pixels()[i]);
      const double off =
          double(luminance(picture.pixels()[i])) - double(luminance(other.pixels()[i]));
      shown[i] += x;
      shown_squares[i] += x * x;
      uniform[i] += u;
      difference[i] += off;
      difference_squares[i] += off * off;
    }
  }
};

/// Unbiased variance out of sums; not below 0, where rounding would bring it.
double variance_of(double sum, double squares, double count) {
  return std::max(0.0, (squares - sum * sum / count) / (count - 1.0));
}

void finish(const Sums& sums, int width, int height, BiasRuns& runs) {
  const double count = double(runs.seconds.size());
  runs.mean = RadianceImage(width, height);
  runs.uniform = RadianceImage(width, height);
  runs.difference = ScalarImage(width, height);
  runs.standard_error = ScalarImage(width, height);
  for (std::size_t i = 0; i < sums.shown.size(); ++i) {
    runs.mean.pixels()[i] = glm::vec3(sums.shown[i] / count);
    runs.uniform.pixels()[i] = glm::vec3(sums.uniform[i] / count);
    runs.difference.pixels()[i] = float(sums.difference[i] / count);
    runs.standard_error.pixels()[i] = float(
        std::sqrt(variance_of(sums.difference[i], sums.difference_squares[i], count) / count));
    for (int c = 0; c < 3; ++c) {
      runs.noise += variance_of(sums.shown[i][c], sums.shown_squares[i][c], count) /
                    (3.0 * double(sums.shown.size()));
    }
  }
}

}  // namespace

std::vector<double> energies_less_uniform(const BiasRuns& runs) {
  std::vector<double> energies = ratio_pseudovalues(runs.luminance, runs.uniform_luminance);
  for (double& energy : energies) {
    energy -= 1.0;
  }
  return energies;
}

double price_of_unbiasedness(const BiasRuns& reuse, const BiasRuns& unbiased) {
  return unbiased.noise * mean_of(unbiased.seconds) / (reuse.noise * mean_of(reuse.seconds));
}

std::vector<BiasRuns> measure_bias(
    std::shared_ptr<const TraceScene> scene, const RenderSettings& settings,
    std::span<const LaneSettings> lane_settings, std::uint32_t passes, std::uint32_t seeds,
    const LabOptions& options, const std::function<void(double)>& progress, std::stop_token stop) {
  std::vector<LaneSettings> lanes;
  for (LaneSettings lane : lane_settings) {
    for (const SampleMode mode : {SampleMode::reuse, SampleMode::unbiased}) {
      lane.mode = mode;
      lanes.push_back(lane);
    }
  }
  std::vector<BiasRuns> runs(lanes.size());
  std::vector<Sums> sums(lanes.size(),
                         Sums(std::size_t(settings.width) * std::size_t(settings.height)));
  for (std::uint32_t k = 0; k < seeds; ++k) {
    RenderSettings own = settings;
    own.seed += k;
    const SampleSource source = sample_source(scene, own);
    LabOptions lab_options = options;
    lab_options.pilot_source = pilot_source(scene, own);
    Lab lab(source, own.width, own.height, lanes, lab_options);
    const bool ended = run_lab(lab, stop, [&] {
      progress((k + 0.8 * double(lab.pass()) / double(passes)) / double(seeds));
      return lab.pass() < passes;
    });
    if (!ended) {
      return {};
    }
    // Both modes of a lane against the same uniform picture.
    const auto uniform_spp = [&](std::size_t lane) {
      const Lane& reuse = lab.lanes()[lane - lane % 2];
      return std::uint32_t(std::lround(mean_spp(reuse.history().back(), reuse.film().size())));
    };
    Uniform uniform;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      uniform.try_emplace(uniform_spp(i), own.width, own.height);
    }
    make_uniform(source, uniform);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const Lane& lane = lab.lanes()[i];
      const RadianceImage shown = lane.film().image();
      const RadianceImage& other = uniform.at(uniform_spp(i));
      const PassRecord& last = lane.history().back();
      runs[i].settings = lanes[i];
      runs[i].mean_spp.push_back(mean_spp(last, shown.size()));
      runs[i].mean_rays.push_back(mean_rays(last, shown.size()));
      runs[i].seconds.push_back(last.seconds);
      runs[i].luminance.push_back(mean_luminance(shown));
      runs[i].uniform_luminance.push_back(mean_luminance(other));
      keep_most(runs[i].rejected, rejected_of(lane, own.seed));
      keep_most(runs[i].capped, capped_pixels(lane));
      runs[i].partial |= lab.partial();
      sums[i].add(shown, other);
    }
    progress(double(k + 1) / double(seeds));
  }
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    finish(sums[i], settings.width, settings.height, runs[i]);
  }
  return runs;
}

}  // namespace quartet
