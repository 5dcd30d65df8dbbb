#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/adaptive/lab.h"
#include "renderer/measure/capped.h"
#include "renderer/measure/rejected_count.h"

namespace quartet {

/// Independent runs of one lane in one mode, compared with uniform sampling of the same random
/// numbers and the same mean number of samples, which has no bias.
struct BiasRuns {
  LaneSettings settings;
  std::vector<double> mean_spp;           ///< one a seed; the pilot's samples included
  std::vector<double> mean_rays;          ///< a pixel, the pilot's included
  std::vector<double> seconds;            ///< as if alone
  std::vector<double> luminance;          ///< mean of the picture
  std::vector<double> uniform_luminance;  ///< the same of uniform sampling
  RadianceImage mean;                     ///< over the seeds
  RadianceImage uniform;                  ///< the same of uniform sampling
  ScalarImage difference;                 ///< luminance of mean less that of uniform
  ScalarImage standard_error;             ///< of `difference`, from its spread over the seeds
  RejectedCount rejected;                 ///< of the seed that met most
  CappedPixels capped;                    ///< of the seed that has most
  double noise = 0.0;    ///< variance of a picture over the seeds, mean over pixels and channels
  bool partial = false;  ///< memory was short with one of the seeds: samples were forgotten
};

/// Mean luminance over that of uniform sampling, less 1, a number a seed: their mean is that of all
/// seeds, with its interval and its test. They are not each seed's own ratio, whose mean is off
/// where few pixels are noisy (ratio_pseudovalues()): at 6 × 4 pixels by +2 % of a picture without
/// bias.
std::vector<double> energies_less_uniform(const BiasRuns& runs);

/// What it takes in seconds to bring the noise of mode unbiased down to that of reuse, over what
/// reuse took: both fall as 1/samples.
double price_of_unbiasedness(const BiasRuns& reuse, const BiasRuns& unbiased);

/// Runs each lane in both modes, `passes` passes with each of the seeds settings.seed,
/// settings.seed + 1, …, at least 2; results are reuse, unbiased, reuse, … in the order of the
/// lanes. `progress` gets the share that is done. Empty if `stop` ended it early.
std::vector<BiasRuns> measure_bias(std::shared_ptr<const TraceScene> scene,
                                   const RenderSettings& settings,
                                   std::span<const LaneSettings> lane_settings,
                                   std::uint32_t passes, std::uint32_t seeds,
                                   const LabOptions& options,
                                   const std::function<void(double)>& progress,
                                   std::stop_token stop = {});

}  // namespace quartet
