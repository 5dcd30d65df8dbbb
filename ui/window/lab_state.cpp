#include "ui/window/lab_state.h"

#include "renderer/scene/synthetic.h"

namespace quartet {

LabState initial_state() {
  LabState state;
  for (const Estimator& row : estimators()) {
    if (row.channels > 0 && state.request.lanes.settings.size() < lane_count) {
      state.request.lanes.settings.push_back(default_settings(row.key));
    }
  }
  for (LaneSlots& slots : state.slots) {
    slots = {SlotChoice{ViewKind::image, 0}, SlotChoice{ViewKind::heatmap, 0}};
  }
  return state;
}

void set_scene(LabState& state, std::shared_ptr<const TraceScene> scene) {
  const RenderSettings old = state.request.store.settings;
  state.request.store.settings = default_settings(scene->scene());
  if (const auto& before = state.request.store.scene) {
    if (why_not(scene->scene(), old.integrator).empty()) {
      state.request.store.settings.integrator = old.integrator;
    }
    state.request.store.settings.seed = old.seed;
    // What stood in for a scene had its own, which was no choice.
    if (synthetic_of(before->scene()) == nullptr) {
      state.request.store.settings.sampler = sampler_for(scene->scene(), old.sampler);
    }
  }
  state.camera = camera_controls(*scene);
  state.request.store.scene = std::move(scene);
  state.pan_zoom = {};
  state.hovered.reset();
  state.pinned.reset();
}

}  // namespace quartet
