#include "renderer/trace/integrator.h"

#include <array>

#include "renderer/table.h"
#include "renderer/trace/path_lanes.h"

namespace quartet {
namespace {

constexpr std::array table{
    Integrator{
        IntegratorId::kajiya, "kajiya", "Kajiya",
        "BSDF sampling and Russian roulette only: slow, and the ground truth; no point lights",
        trace_lanes<false>},
    Integrator{IntegratorId::mis, "mis", "MIS",
               "light and BSDF sampling, power heuristic, Russian roulette", trace_lanes<true>},
};

}  // namespace

RenderSettings default_settings(const Scene& scene) {
  return {.camera = scene.camera,
          .width = scene.width,
          .height = scene.height,
          .max_depth = scene.max_depth};
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
