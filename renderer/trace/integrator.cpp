#include "renderer/trace/integrator.h"

#include <array>

#include "renderer/table.h"
#include "renderer/trace/path.h"

namespace quartet {
namespace {

template <bool NextEvent>
void trace(const TraceScene& scene, const RenderSettings& settings, const CameraRays& camera, int x,
           int y, std::uint32_t first, std::span<glm::vec3> radiance) {
  const auto pixel = std::uint32_t(y) * std::uint32_t(settings.width) + std::uint32_t(x);
  NoObserver observer;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    Sampler sampler(settings.seed, pixel, first + std::uint32_t(i));
    const Ray ray = camera.ray(x, y, sampler.next());
    radiance[i] = trace_path<NextEvent>(scene, ray, sampler, settings.max_depth, observer);
  }
}

constexpr std::array table{
    Integrator{IntegratorId::kajiya, "kajiya", "Kajiya",
               "BSDF sampling and Russian roulette only: slow, and the ground truth", trace<false>},
    Integrator{IntegratorId::mis, "mis", "MIS",
               "light and BSDF sampling, power heuristic, Russian roulette", trace<true>},
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
