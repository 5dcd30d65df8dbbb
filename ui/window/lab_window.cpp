#include "ui/window/lab_window.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "renderer/base/interval.h"
#include "ui/widgets/widgets.h"
#include "ui/window/dock.h"
#include "ui/window/lane_column.h"
#include "ui/window/menus/dialogs.h"
#include "ui/window/menus/scene_menu.h"
#include "ui/window/status_bar.h"
#include "ui/window/toolbar.h"

namespace quartet {
namespace {

constexpr float side_gap = 6.0f;

/// What the renderer must keep for what is looked at.
bool wants_variance(const LabState& state) {
  return std::ranges::any_of(state.slots, [](const LaneSlots& slots) {
    return std::ranges::any_of(
        slots, [](const SlotChoice& choice) { return view_row(choice.kind).needs.variance; });
  });
}

/// What does not fit a part of a small window ends at that part's edge, and does not lie over its
/// neighbours.
class ClippedTo {
 public:
  explicit ClippedTo(const ScreenRect& box) {
    ImGui::PushClipRect({box.x, box.y}, {box.right(), box.bottom()}, true);
  }
  ~ClippedTo() { ImGui::PopClipRect(); }
  ClippedTo(const ClippedTo&) = delete;
  ClippedTo& operator=(const ClippedTo&) = delete;
};

/// The lanes of the large view, to choose from, above it.
void draw_lane_tabs(LabFrame& frame, ScreenRect box) {
  Ui& ui = frame.ui;
  Comparison& comparison = frame.state.comparison;
  const float y = box.y + ui.px(3.0f);
  float x = box.x + ui.px(8.0f);
  const auto button = [&](const std::string& name, const std::string& text, ImU32 color, bool on) {
    const float width = text_width(ui.body, text) + ui.px(18.0f);
    ImGui::SetCursorScreenPos({x, y});
    ImGui::PushStyleColor(ImGuiCol_Button, on ? with_alpha(color, 0.25f) : 0);
    ImGui::PushStyleColor(ImGuiCol_Text, on ? color : palette::dim);
    const bool pressed = ImGui::Button((text + "##" + name).c_str(), {width, 0.0f});
    ImGui::PopStyleColor(2);
    ui.mark(name);
    x += width + ui.px(4.0f);
    return pressed;
  };
  for (std::size_t i = 0; i < frame.state.request.lanes.settings.size(); ++i) {
    const std::string text =
        std::to_string(i + 1) + "  " +
        std::string(estimator(frame.state.request.lanes.settings[i].estimator).label);
    if (button("tab" + std::to_string(i), text, frame.lane_color(i), i == comparison.lane)) {
      comparison.choose(i);
    }
  }
  x += ui.px(16.0f);
  const std::string b = "B: lane " + std::to_string(comparison.other + 1);
  if (button("other", b, frame.lane_color(comparison.other), true)) {
    do {
      comparison.other = (comparison.other + 1) % frame.state.request.lanes.settings.size();
    } while (comparison.other == comparison.lane);
  }
  tooltip(ui, "The lane to compare with; a click takes the next one");
  if (button("flip", "flip A, B", palette::text, false)) {
    std::swap(comparison.lane, comparison.other);
  }
  tooltip(ui, "A and B change places  (A)");
  if (button("wipe_toggle", "wipe", palette::text, comparison.wipe)) {
    comparison.wipe = !comparison.wipe;
  }
  tooltip(ui, "A line between A and B, to be dragged  (W)");
}

}  // namespace

LabWindow::LabWindow(LabState state, UploadTexture upload)
    : state_(std::move(state)), pictures_(std::move(upload)) {
  last_store_ = state_.request.store;
}

bool LabWindow::rescale(float natural) {
  const float wanted = state_.ui_scale > 0.0f ? state_.ui_scale : natural;
  if (ui_.body && wanted == ui_.scale) {
    return false;
  }
  set_theme(ui_, wanted);
  return true;
}

void LabWindow::scene_loaded(std::shared_ptr<const TraceScene> scene, const std::string& asked) {
  set_scene(state_, std::move(scene));
  state_.scene = asked;
  state_.failure = nullptr;
  message_ = {};
  if (const FailureCase* const failure = std::exchange(state_.failure_asked, nullptr);
      failure && failure->scene == asked) {
    show_failure(state_, *failure);
    say(Message::Kind::notice, std::string(failure->watch));
  }
}

void LabWindow::scene_failed(const std::string& reason) {
  state_.failure_asked = nullptr;
  say(Message::Kind::error, reason);
}

/// The exposure at which all but one pixel in a hundred of the chosen lane stay below white.
void LabWindow::normalize_exposure() {
  state_.normalize = false;
  if (!snapshot_ || state_.comparison.lane >= snapshot_->lanes.size()) {
    return;
  }
  const auto& mean = snapshot_->lanes[state_.comparison.lane].mean;
  std::vector<float> largest(mean[0].size());
  for (std::size_t i = 0; i < largest.size(); ++i) {
    largest[i] = std::max({mean[0][i], mean[1][i], mean[2][i]});
  }
  if (largest.empty()) {
    return;
  }
  const std::size_t clipped = largest.size() / 100;
  const float white = largest_but(std::move(largest), clipped);
  if (white > 0.0f) {
    state_.view.exposure = std::clamp(-std::log2(white), -largest_exposure, largest_exposure);
  }
}

/// What follows from the rest of the state, so that no widget and no key needs to think of it.
void LabWindow::keep_request_consistent(bool reference_pending) {
  LabRequest& request = state_.request;
  request.lanes.variance = wants_variance(state_);
  if (request.store != last_store_) {
    state_.playback.forget();
    request.lanes.reference.reset();  // of another view; the next frame will bring what is right
    reference_pending = true;
  }
  request.lanes.pass = state_.playback.wanted();
  // Without the truth there is nothing that such a lane could look at.
  for (LaneSettings& settings : request.lanes.settings) {
    if (!request.lanes.reference && !reference_pending &&
        estimator(settings.estimator).needs_reference) {
      settings = default_settings(EstimatorId::uniform);
    }
  }
  last_store_ = request.store;
}

void LabWindow::draw_lanes(LabFrame& frame, const ScreenRect& area) {
  const std::size_t count = state_.request.lanes.settings.size();
  const ColumnWish wish = column_wish(frame);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (state_.layout == LabLayout::large) {
    ScreenRect box = area;
    draw_lane_tabs(frame, box.cut_top(ui_.px(30.0f)));
    const ClippedTo panel(box);
    draw_lane_column(frame, state_.comparison.lane, lay_out_large(ui_, box, wish));
    return;
  }
  const std::vector<ScreenRect> panels = lane_panels(ui_, area, state_.layout, count);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const ClippedTo panel(panels[i]);
    draw_lane_column(frame, i,
                     state_.layout == LabLayout::grid ? lay_out_cell(ui_, panels[i], wish)
                                                      : lay_out_column(ui_, panels[i], wish));
  }
  for (const ScreenRect& panel : panels) {
    // Only the gaps are painted: the window is cleared to the panels' colour, and fill is what
    // costs where no graphics card draws.
    if (panel.right() < area.right() - 1) {
      list.AddRectFilled({panel.right(), panel.y},
                         {panel.right() + ui_.px(side_gap), panel.bottom()}, palette::gap);
    }
    if (panel.bottom() < area.bottom() - 1) {
      list.AddRectFilled({panel.x, panel.bottom()},
                         {panel.right() + ui_.px(side_gap), panel.bottom() + ui_.px(side_gap)},
                         palette::gap);
    }
  }
}

LabOrders LabWindow::draw(const LabInput& input) {
  snapshot_ = input.snapshot;
  const std::shared_ptr<const Reference>& reference = input.reference.reference;
  // It lives as long as the whole of which it is a part.
  state_.request.lanes.reference = {reference, reference ? &reference->image : nullptr};
  LabOrders orders;
  state_.can_cancel = input.loading || input.saving ||
                      input.reference.activity == ReferenceStatus::Activity::loading;
  orders.cancel = std::exchange(state_.cancel, false);
  ui_.widgets.clear();
  ui_.held.clear();
  if (state_.normalize) {
    normalize_exposure();
  }
  const bool current = snapshot_ && snapshot_->scene == state_.request.store.scene &&
                       snapshot_->settings == state_.request.store.settings;
  orders.animate = state_.playback.update(current ? snapshot_->pass : 0, input.seconds);

  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("lab", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  ImGui::PushFont(ui_.body);
  LabFrame frame{ui_,
                 state_,
                 snapshot_.get(),
                 input.status,
                 input.loading,
                 input.saving,
                 input.reference,
                 input.evaluation,
                 input.equalising,
                 input.rejected,
                 pictures_,
                 message_,
                 orders};
  ScreenRect area{0, 0, size.x, size.y};
  const ScreenRect status = area.cut_bottom(status_bar_height(ui_));
  const ScreenRect toolbar = area.cut_top(toolbar_height(frame, area.width));
  {
    const ClippedTo box(toolbar);
    draw_toolbar(frame, toolbar);
  }
  ImGui::GetWindowDrawList()->AddRectFilled(
      {0, toolbar.bottom()}, {size.x, toolbar.bottom() + ui_.px(side_gap)}, palette::gap);
  area.cut_top(ui_.px(side_gap));
  const ScreenRect below_toolbar = area;
  const ScreenRect dock = area.cut_bottom(dock_height(frame, below_toolbar));
  draw_lanes(frame, area);
  {
    // With the half of its edge's handle that lies over the lanes.
    const float handle = std::min(ui_.px(4.0f), area.height);
    const ClippedTo box({dock.x, dock.y - handle, dock.width, dock.height + handle});
    draw_dock(frame, below_toolbar, dock);
  }
  draw_status_bar(frame, status);
  draw_help(frame);
  draw_export_form(frame);
  ImGui::PopFont();
  ImGui::End();
  state_.hovered = frame.hovered;
  keep_request_consistent(input.reference_pending);
  return orders;
}

}  // namespace quartet
