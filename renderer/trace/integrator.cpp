#include "renderer/trace/integrator.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "renderer/base/table.h"
#include "renderer/scene/synthetic.h"
#include "renderer/trace/path_lanes.h"

namespace quartet {
namespace {

constexpr std::array table{
    Integrator{
        IntegratorId::kajiya, "kajiya", "Kajiya",
        "BSDF sampling and Russian roulette only: slow, and the ground truth; no point lights",
        false, trace_lanes<false>},
    Integrator{IntegratorId::mis, "mis", "MIS",
               "light and BSDF sampling, power heuristic, Russian roulette", true,
               trace_lanes<true>},
};

}  // namespace

SamplerId sampler_for(const Scene& scene, SamplerId asked) {
  return synthetic_of(scene) ? SamplerId::independent : asked;
}

RenderSettings default_settings(const Scene& scene) {
  return {.camera = scene.camera,
          .width = scene.width,
          .height = scene.height,
          .max_depth = scene.max_depth,
          .sampler = sampler_for(scene, RenderSettings().sampler)};
}

std::string why_not(const Scene& scene, IntegratorId key) {
  const Integrator& row = integrator(key);
  if (row.finds_points || scene.delta_lights.empty()) {
    return {};
  }
  return fmt::format(
      "integrator {} cannot find point lights, and the scene '{}' has {}: its picture would be too "
      "dark; mis can",
      row.id, scene.name, scene.delta_lights.size());
}

void check_integrator(const Scene& scene, IntegratorId key) {
  if (const std::string reason = why_not(scene, key); !reason.empty()) {
    throw std::invalid_argument(reason);
  }
}

std::span<const Integrator> integrators() {
  return table;
}

const Integrator& integrator(IntegratorId key) {
  return row_of(integrators(), key);
}

const Integrator& find_integrator(std::string_view id) {
  return find_row(integrators(), id, "integrator");
}

}  // namespace quartet
