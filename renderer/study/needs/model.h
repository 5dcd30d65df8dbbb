#pragma once

#include <memory>

#include "renderer/trace/integrator.h"

namespace quartet {

/// What a picture is made of: a scene, and how its samples are traced. Camera, size and depth are
/// those of the scene.
struct Model {
  Scene scene;
  IntegratorId integrator = IntegratorId::mis;
  SamplerId sampler = SamplerId::sobol;
  bool roulette = true;
};

/// That of a scene that is rendered with these settings.
Model model_of(const Scene& scene, const RenderSettings& settings);
RenderSettings settings_of(const Model& model, std::uint64_t seed);

}  // namespace quartet
