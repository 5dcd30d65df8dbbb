#include "renderer/study/sample_world.h"

namespace quartet {

SampleWorld sample_world(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings,
                         const LabOptions& lab, std::shared_ptr<const RadianceImage> reference) {
  SampleWorld world;
  world.first_seed = settings.seed;
  world.width = settings.width;
  world.height = settings.height;
  world.lab = lab;
  world.reference = std::move(reference);
  const auto seeded = [settings](std::uint64_t seed) {
    RenderSettings with_seed = settings;
    with_seed.seed = seed;
    return with_seed;
  };
  world.source = [scene, seeded](std::uint64_t seed) { return sample_source(scene, seeded(seed)); };
  world.pilot = [scene, seeded](std::uint64_t seed) { return pilot_source(scene, seeded(seed)); };
  return world;
}

LabOptions lab_options(const SampleWorld& world, std::uint64_t seed) {
  LabOptions options = world.lab;
  options.reference = world.reference;
  options.pilot_source = world.pilot ? world.pilot(seed) : SampleSource();
  return options;
}

Experiment make_experiment(const SampleWorld& world, std::uint64_t seed) {
  return {world.source(seed), world.width, world.height, lab_options(world, seed), world.reference};
}

}  // namespace quartet
