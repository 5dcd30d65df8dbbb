#include "renderer/measure/truth.h"

#include <algorithm>
#include <cassert>

#include "renderer/measure/reference_render.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr float relative_floor = 0.01f;  // as in relmse

}  // namespace

std::shared_ptr<const Truth> find_truth(std::shared_ptr<const TraceScene> scene,
                                        const RenderSettings& settings, const TruthEffort& effort,
                                        const std::function<bool(double)>& go_on) {
  auto truth = std::make_shared<Truth>();
  if (const Synthetic* row = synthetic_of(scene->scene())) {
    truth->image = std::make_shared<const RadianceImage>(settings.width, settings.height,
                                                         glm::vec3(float(row->mean)));
    return truth;
  }
  RenderSettings own = settings;
  own.seed = reference_seed;
  ReferenceRender render(std::move(scene), own);
  constexpr std::uint32_t step = 128;
  for (std::uint32_t spp = 0; spp < effort.most_spp;) {
    const std::uint32_t some = std::min(step, effort.most_spp - spp);
    render.add(some);
    spp += some;
    if (!go_on(double(spp) / double(effort.most_spp))) {
      return nullptr;
    }
    // The noise of few samples is not known well enough to stop by.
    constexpr std::uint32_t least_spp = 512;
    const bool is_round = (spp & (spp - 1)) == 0;
    if (spp == effort.most_spp || (is_round && spp >= least_spp)) {
      const auto reference = render.reference();
      truth->image = std::make_shared<const RadianceImage>(reference->image);
      truth->noise = reference->noise_floor(MetricId::relmse);
      truth->spp = spp;
      if (truth->noise <= effort.noise) {
        break;
      }
    }
  }
  return truth;
}

void squared_errors(const Film& film, const RadianceImage& truth, std::span<float> error) {
  assert(truth.size() == film.size() && error.size() == film.size());
  const float* red = film.mean(0).data();
  const float* green = film.mean(1).data();
  const float* blue = film.mean(2).data();
  const glm::vec3* right = truth.pixels().data();
  const auto term = [](float x, float r) { return (x - r) * (x - r) / (r * r + relative_floor); };
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = (term(red[i], right[i].x) + term(green[i], right[i].y) + term(blue[i], right[i].z)) *
               (1.0f / 3.0f);
  }
}

}  // namespace quartet
