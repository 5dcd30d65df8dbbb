#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/session/session.h"
#include "renderer/study/stability/failure_case.h"
#include "renderer/view/effort_chart.h"
#include "renderer/view/lane_charts.h"
#include "renderer/view/views.h"
#include "ui/widgets/camera_controls.h"
#include "ui/widgets/pan_zoom.h"
#include "ui/window/playback.h"

namespace quartet {

inline constexpr std::size_t lane_count = 4;

/// In stops, up or down: beyond it a float may leave its range.
inline constexpr float largest_exposure = 100.0f;

enum class LabLayout { columns, grid, large };

/// What one picture slot of a lane shows.
struct SlotChoice {
  ViewKind kind = ViewKind::image;
  std::size_t other = 0;  ///< difference: the lane that is subtracted
  bool operator==(const SlotChoice&) const = default;
};

using LaneSlots = std::array<SlotChoice, 2>;

/// Two lanes in the large view.
struct Comparison {
  std::size_t lane = 0;   ///< A, the large one
  std::size_t other = 1;  ///< B
  bool wipe = false;      ///< A left of the line, B right of it
  float wipe_at = 0.5f;   ///< in parts of the slot

  /// Makes a lane A; if it was B, the two change places.
  void choose(std::size_t a) {
    other = other == a ? lane : other;
    lane = a;
  }
};

/// The axis of a lane's errors while a threshold on it is dragged: it must not move under the
/// mouse.
struct HeldAxis {
  std::size_t lane = 0;
  DecadeRange decades;
  bool by_marker = false;  ///< the threshold's line in the plot, else something beside the plot
};

enum class DockView { curves, quality };

/// The dock under the lanes: how far they are from a reference.
struct DockState {
  /// As the user chose; else it opens by itself once there is a reference and room for both.
  std::optional<bool> open;
  bool toggle = false;  ///< at the next frame, which knows whether it is open
  float height = 0.0f;  ///< when open, at scale 1; 0: what suits the window
  Effort effort = Effort::seconds;
  DockView view = DockView::curves;
};

struct ReferenceForm {
  std::uint64_t spp = 1024;  ///< to compute
  std::string path;          ///< to load
};

/// What all lanes shall have in common, to be edited.
struct EqualiseForm {
  float spp = 0.0f;
  float seconds = 0.0f;
  float error = 0.0f;  ///< in the metric of the request
};

struct ExportForm {
  bool open = false;
  std::string folder = "quartet-export";
  int lane = -1;  ///< one panel of this lane, or all four
};

/// All that the window knows between two frames of its own: what the user asks of the renderer, and
/// how the answer is looked at. Plain data: keys, widgets and tests edit it.
struct LabState {
  LabRequest request;
  CameraControls camera;
  Playback playback;

  ViewSettings view;
  std::array<LaneSlots, lane_count> slots;
  LabLayout layout = LabLayout::columns;
  Comparison comparison;
  bool hold_first = false;      ///< lane 1 is shown in the place of all
  bool hold_reference = false;  ///< the reference is shown in the place of all images
  PanZoom pan_zoom;
  std::optional<glm::ivec2> hovered;  ///< pixel under the mouse
  std::optional<glm::ivec2> pinned;   ///< pixel that was clicked
  std::optional<HeldAxis> held_axis;
  bool normalize = false;  ///< set the exposure to the picture, at the next frame

  std::string scene = "cornell-checker";  ///< as asked for: a built-in name, or a file
  std::string path_field;
  const FailureCase* failure = nullptr;        ///< that the scene was loaded for
  const FailureCase* failure_asked = nullptr;  ///< the same, of the scene that is being loaded
  bool help_open = false;
  float ui_scale = 0.0f;  ///< 0: as the monitor says
  DockState dock;
  ReferenceForm reference_form;
  EqualiseForm equalise_form;
  ExportForm export_form;
  bool can_cancel = false;  ///< something is being loaded or saved
  bool cancel = false;      ///< it shall end, at the next frame
  bool quit = false;

  const TraceScene* trace_scene() const { return request.store.scene.get(); }
};

/// The four estimators with a threshold, in the order of the table, and the usual views.
LabState initial_state();

/// Gives the state a scene that was loaded: its camera, its size, its depth. Integrator,
/// sampler, seed, lanes and views stay.
void set_scene(LabState& state, std::shared_ptr<const TraceScene> scene);

}  // namespace quartet
