#include "ui/window/pictures/read_out.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"
#include "ui/window/pictures/pixel_text.h"

namespace quartet {
namespace {

struct ReadOut {
  std::string radiance;
  std::vector<std::string> rest;  ///< from the longest to the shortest
};

ReadOut read_out(const LabFrame& frame, std::size_t source, glm::ivec2 pixel) {
  const LaneSnapshot& lane = *frame.lane(source);
  const auto index =
      std::size_t(pixel.y) * std::size_t(frame.snapshot->width) + std::size_t(pixel.x);
  const PixelValues values = pixel_values(lane, index);
  const bool known = frame.rejected && frame.rejected->pixel == pixel;
  return {fmt::format("{}, {}   rgb {}", pixel.x, pixel.y, three_numbers(values.radiance)),
          read_out_texts(estimator(lane.settings.estimator), values,
                         known ? std::optional(frame.rejected->index) : std::nullopt)};
}

float read_out_line(const Ui& ui) {
  return font_size(ui.small) + ui.px(4.0f);
}

float read_out_height(const Ui& ui) {
  return 2 * read_out_line(ui) + ui.px(4.0f);
}

/// Two lines of text on the lower edge of the slot.
void draw_read_out_strip(LabFrame& frame, const PictureSlot& slot,
                         const std::array<std::pair<ImU32, std::string>, 2>& lines) {
  Ui& ui = frame.ui;
  const float height = read_out_height(ui);
  const ScreenRect strip{slot.box.x, slot.box.bottom() - height, slot.box.width, height};
  ImGui::GetWindowDrawList()->AddRectFilled({strip.x, strip.y}, {strip.right(), strip.bottom()},
                                            palette::shade);
  float y = strip.y + ui.px(3.0f);
  for (const auto& [color, text] : lines) {
    text_at(ui.small, strip.x + ui.px(5.0f), y, color, text);
    y += read_out_line(ui);
  }
  ui.mark(slot_name(slot) + ".read_out", strip);
}

float read_out_room(const Ui& ui, const PictureSlot& slot) {
  return slot.box.width - ui.px(10.0f);
}

}  // namespace

std::optional<glm::ivec2> read_out_pixel(const LabState& state, const Snapshot* snapshot) {
  const std::optional<glm::ivec2> pixel = state.hovered ? state.hovered : state.pinned;
  const bool inside =
      pixel && snapshot && pixel->x < snapshot->width && pixel->y < snapshot->height;
  return inside ? pixel : std::nullopt;
}

void draw_read_out(LabFrame& frame, const PictureSlot& slot, glm::ivec2 pixel) {
  const ReadOut text = read_out(frame, slot.source, pixel);
  draw_read_out_strip(
      frame, slot,
      {{{palette::text, text.radiance},
        {palette::text, fitting_text(frame.ui.small, text.rest, read_out_room(frame.ui, slot))}}});
}

void draw_wipe_read_out(LabFrame& frame, const PictureSlot& a, const PictureSlot& b,
                        glm::ivec2 pixel) {
  const auto line = [&](const char* name, std::size_t source) {
    const ReadOut text = read_out(frame, source, pixel);
    std::vector<std::string> lines;
    for (const std::string& rest : text.rest) {
      lines.push_back(fmt::format("{}: lane {}   {}   {}", name, source + 1, text.radiance, rest));
    }
    return std::pair(frame.lane_color(source),
                     fitting_text(frame.ui.small, lines, read_out_room(frame.ui, a)));
  };
  draw_read_out_strip(frame, a, {line("A", a.source), line("B", b.source)});
}

}  // namespace quartet
