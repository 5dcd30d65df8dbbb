#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "renderer/study/experiment.h"

namespace quartet {

/// What experiments draw their samples from, seed by seed.
struct SampleWorld {
  std::function<SampleSource(std::uint64_t seed)> source;
  std::function<SampleSource(std::uint64_t seed)>
      pilot;                     ///< for SampleMode::unbiased; may be empty
  std::uint64_t first_seed = 0;  ///< then the ones that follow
  int width = 0;
  int height = 0;
  LabOptions lab;
  std::shared_ptr<const RadianceImage> reference;  ///< as large as the picture
};

/// The options of a lab that draws from it with a seed: with its pilot source, and the reference
/// for estimators that look at it.
LabOptions lab_options(const SampleWorld& world, std::uint64_t seed);
/// Runs over samples of one seed, none of which is traced yet.
Experiment make_experiment(const SampleWorld& world, std::uint64_t seed);

/// The tracer, with the settings but for their seed, which is the first one.
SampleWorld sample_world(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings,
                         const LabOptions& lab, std::shared_ptr<const RadianceImage> reference);

}  // namespace quartet
