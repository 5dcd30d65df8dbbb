#include "ui/window/status_bar.h"

#include <fmt/format.h>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"

namespace quartet {
namespace {

std::string count_text(double count) {
  return count >= 1e9   ? fmt::format("{:.2f} G", count * 1e-9)
         : count >= 1e6 ? fmt::format("{:.1f} M", count * 1e-6)
         : count >= 1e3 ? fmt::format("{:.0f} k", count * 1e-3)
                        : fmt::format("{:.0f}", count);
}

std::string bytes_text(double bytes) {
  constexpr double mib = 1024.0 * 1024.0;
  return bytes >= 1024.0 * mib ? fmt::format("{:.1f} GB", bytes / (1024.0 * mib))
                               : fmt::format("{:.0f} MB", bytes / mib);
}

std::string activity_text(const SessionStatus& status) {
  using Activity = SessionStatus::Activity;
  const std::string target = status.pass_target == LaneRequest::no_end
                                 ? std::string("∞")
                                 : fmt::format("{}", status.pass_target);
  switch (status.activity) {
    case Activity::tracing:
      return fmt::format("tracing after pass {} of {} · {} samples/s", status.pass, target,
                         count_text(status.samples_per_second));
    case Activity::replaying:
      return fmt::format("replaying to pass {}", target);
    case Activity::idle:
      break;
  }
  return status.pass > 0 ? fmt::format("all lanes at pass {}", status.pass) : "idle";
}

/// Ends what is being loaded or saved; at `right`. Returns its width.
float draw_cancel(LabFrame& frame, const ScreenRect& box, float right) {
  const Ui& ui = frame.ui;
  const std::string text = "cancel  ×";
  const float width = text_width(ui.small, text);
  ImGui::SetCursorScreenPos({right - width, box.y});
  if (invisible_button("cancel", {width, box.height})) {
    frame.orders.cancel = true;
  }
  frame.ui.mark("cancel");
  tooltip(ui, "Ends what is being loaded or saved  (Esc)");
  text_at(ui.small, right - width, box.y + 0.5f * (box.height - font_size(ui.small)),
          ImGui::IsItemHovered() ? palette::text : palette::dim, text);
  return width;
}

}  // namespace

std::string status_text(const SessionStatus& status, bool loading, bool saving) {
  std::string text = loading ? "loading the scene" : saving ? "saving" : activity_text(status);
  if (status.stored_samples > 0) {
    text += fmt::format(" · {} samples stored, {} of {}", count_text(double(status.stored_samples)),
                        bytes_text(double(status.stored_bytes)),
                        bytes_text(double(status.memory_budget)));
  }
  if (status.partial) {
    text += " · memory full: replays trace again";
  }
  if (status.replay_seconds > 0.0) {
    text += fmt::format(" · last replay {:.0f} ms", 1000.0 * status.replay_seconds);
  }
  return text;
}

float status_bar_height(const Ui& ui) {
  return font_size(ui.small) + ui.px(10.0f);
}

void draw_status_bar(LabFrame& frame, const ScreenRect& box) {
  Ui& ui = frame.ui;
  const float y = box.y + 0.5f * (box.height - font_size(ui.small));
  const float pad = ui.px(10.0f);
  ImGui::GetWindowDrawList()->AddRectFilled({box.x, box.y}, {box.right(), box.bottom()},
                                            palette::gap);
  // The status comes first.
  const std::string hint = fitting_text(ui.small, {"H shows all keys", ""}, 0.4f * box.width);
  text_left_of(ui.small, box.right() - pad, y, palette::faint, hint);
  float room = box.width - 3 * pad - text_width(ui.small, hint);
  if (frame.state.can_cancel) {
    room -= draw_cancel(frame, box, box.x + pad + room) + pad;
  }

  Message message = frame.message;
  if (!frame.status.error.empty()) {
    message = {Message::Kind::error, frame.status.error};
  }
  if (message.kind == Message::Kind::none) {
    const std::string text = status_text(frame.status, frame.loading, frame.saving);
    text_at(ui.small, box.x + pad, y, palette::dim,
            fitting_text(ui.small, {text, text.substr(0, text.find(" · "))}, room));
    ui.mark("status", box);
    return;
  }
  // The end of a long path says more than its beginning, but the reason comes last of all: what
  // does not fit stands in the tooltip.
  const bool error = message.kind == Message::Kind::error;
  std::string text = message.text;
  const std::string more = " … (point here)  ×";
  std::string shown = text + "  ×";
  while (text_width(ui.small, shown) > room && text.size() > 8) {
    do {
      text.pop_back();
    } while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0u) == 0x80u);
    shown = text + more;
  }
  ImGui::SetCursorScreenPos({box.x + pad, box.y});
  if (invisible_button("message", {text_width(ui.small, shown), box.height})) {
    frame.message = {};
  }
  ui.mark("message");
  tooltip(ui, message.text + "\n(a click puts this away)");
  text_at(ui.small, box.x + pad, y, error ? palette::error : palette::good, shown);
}

}  // namespace quartet
