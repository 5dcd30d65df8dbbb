#include "renderer/study/stability/truth.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "renderer/measure/reference/reference_render.h"
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
  const RenderSettings own = reference_settings(scene->scene(), settings);
  ReferenceRender render(std::move(scene), own);
  while (true) {
    constexpr std::uint32_t step = 128;
    const std::uint64_t spp = render.sums().spp;
    render.add(std::uint32_t(std::min<std::uint64_t>(step, effort.most_spp - spp)));
    truth->spp = render.sums().spp;
    if (!go_on(double(truth->spp) / double(effort.most_spp))) {
      return nullptr;
    }
    // The noise of few samples is not known well enough to stop by.
    constexpr std::uint64_t least_spp = 512;
    const bool at_most = truth->spp == effort.most_spp;
    if (at_most || (std::has_single_bit(truth->spp) && truth->spp >= least_spp)) {
      const std::shared_ptr<const Reference> reference = render.reference();
      truth->image = {reference, &reference->image};
      truth->noise = reference->noise_floor(MetricId::relmse);
      if (at_most || truth->noise <= effort.noise) {
        return truth;
      }
    }
  }
}

std::vector<float> squared_errors(const RadianceImage& picture, const RadianceImage& truth) {
  assert(truth.size() == picture.size());
  std::vector<float> errors(picture.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const glm::vec3 off = picture.pixels()[i] - truth.pixels()[i];
    const glm::vec3 terms = off * off / (truth.pixels()[i] * truth.pixels()[i] + relative_floor);
    errors[i] = (terms.x + terms.y + terms.z) * (1.0f / 3.0f);
  }
  return errors;
}

}  // namespace quartet
