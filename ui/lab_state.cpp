#include "ui/lab_state.h"

namespace quartet {

LabState initial_state() {
  LabState state;
  for (const Estimator& row : estimators()) {
    if (row.channels > 0 && state.request.policies.size() < lane_count) {
      state.request.policies.push_back(default_policy(row.key));
    }
  }
  for (LaneSlots& slots : state.slots) {
    slots = {SlotChoice{ViewKind::image, 0}, SlotChoice{ViewKind::heatmap, 0}};
  }
  return state;
}

void set_scene(LabState& state, std::shared_ptr<const TraceScene> scene) {
  const RenderSettings old = state.request.settings;
  state.request.settings = default_settings(scene->scene());
  if (state.request.scene) {
    if (why_not(scene->scene(), old.integrator).empty()) {
      state.request.settings.integrator = old.integrator;
    }
    state.request.settings.seed = old.seed;
  }
  state.camera = camera_controls(*scene);
  state.request.scene = std::move(scene);
  state.pan_zoom = {};
  state.hovered.reset();
  state.pinned.reset();
}

bool same_request(const LabRequest& a, const LabRequest& b) {
  return a.scene == b.scene && a.settings == b.settings && a.policies == b.policies &&
         a.frame == b.frame && a.variance == b.variance && a.reference == b.reference &&
         a.metric == b.metric && a.memory == b.memory && a.threads == b.threads;
}

}  // namespace quartet
