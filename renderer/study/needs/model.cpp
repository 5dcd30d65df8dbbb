#include "renderer/study/needs/model.h"

namespace quartet {

Model model_of(const Scene& scene, const RenderSettings& settings) {
  Model model{.scene = scene,
              .integrator = settings.integrator,
              .sampler = settings.sampler,
              .roulette = settings.roulette};
  model.scene.camera = settings.camera;
  model.scene.width = settings.width;
  model.scene.height = settings.height;
  model.scene.max_depth = settings.max_depth;
  return model;
}

RenderSettings settings_of(const Model& model, std::uint64_t seed) {
  RenderSettings settings = default_settings(model.scene);
  settings.integrator = model.integrator;
  settings.sampler = model.sampler;
  settings.roulette = model.roulette;
  settings.seed = seed;
  return settings;
}

}  // namespace quartet
