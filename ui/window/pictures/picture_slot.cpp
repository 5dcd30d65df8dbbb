#include "ui/window/pictures/picture_slot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"
#include "ui/window/pictures/picture_cache.h"
#include "ui/window/pictures/pixel_text.h"
#include "ui/window/pictures/read_out.h"

namespace quartet {
namespace {

SlotChoice& choice_of(LabState& state, const PictureSlot& slot) {
  return state.slots[slot.lane][slot.slot];
}

std::string choice_label(const SlotChoice& choice) {
  const std::string label(view_row(choice.kind).label);
  return view_row(choice.kind).needs.other_lane
             ? fmt::format("{} to lane {}", label, choice.other + 1)
             : label;
}

/// The combo box in the corner of the picture.
bool edit_choice(Ui& ui, const PictureSlot& slot, SlotChoice& choice) {
  const float inset = ui.px(5.0f);
  ImGui::SetCursorScreenPos({slot.box.x + inset, slot.box.y + inset});
  ImGui::PushFont(ui.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6.0f), ui.px(2.0f)});
  ImGui::PushStyleColor(ImGuiCol_FrameBg, palette::shade);
  ImGui::PushStyleColor(ImGuiCol_Button, palette::shade);
  const std::string name = slot_name(slot) + ".view";
  const std::string shown = choice_label(choice);
  const float width = text_width(ui.small, shown) + ui.px(14.0f) + ImGui::GetFrameHeight();
  const bool changed = combo(ui, name, shown, width, [&] {
    bool chosen = false;
    for (const ViewRow& row : views()) {
      if (!row.needs.other_lane) {
        if (combo_row(ui, fmt::format("{}.{}", name, row.id), std::string(row.label),
                      choice.kind == row.key, std::string(row.quantity))) {
          choice.kind = row.key;
          chosen = true;
        }
        continue;
      }
      for (std::size_t other = 0; other < lane_count; ++other) {
        const bool current = choice.kind == row.key && choice.other == other;
        if (other != slot.lane && combo_row(ui, fmt::format("{}.{}{}", name, row.id, other),
                                            fmt::format("{} to lane {}", row.label, other + 1),
                                            current, std::string(row.quantity))) {
          choice = {row.key, other};
          chosen = true;
        }
      }
    }
    return chosen;
  });
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  return changed;
}

void draw_note(const Ui& ui, const ScreenRect& box, const std::string& note) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float wrap = std::min(box.width - ui.px(24.0f), ui.px(360.0f));
  const ImVec2 size = ui.body->CalcTextSizeA(font_size(ui.body), FLT_MAX, wrap, note.c_str());
  list.AddText(
      ui.body, font_size(ui.body),
      {std::round(box.center_x() - 0.5f * size.x), std::round(box.center_y() - 0.5f * size.y)},
      palette::dim, note.c_str(), nullptr, wrap);
}

void draw_texture(LabFrame& frame, std::size_t texture, const DisplayImage& image,
                  const PicturePlace& place) {
  glm::vec2 corner(place.x, place.y);
  glm::vec2 size = place.scale * glm::vec2(image.width(), image.height());
  if (place.scale < 1.0f) {
    // A pixel of the reduced picture is then one of the screen.
    corner = glm::round(corner);
    size = glm::max(glm::round(size), glm::vec2(1.0f));
  }
  const ImVec2 density = ImGui::GetIO().DisplayFramebufferScale;
  const std::uintptr_t handle =
      frame.pictures.texture(texture, glm::ivec2(size * glm::vec2(density.x, density.y)));
  const glm::vec2 end = corner + size;
  ImGui::GetWindowDrawList()->AddImage(texture_id(handle), {corner.x, corner.y}, {end.x, end.y});
}

/// A frame around a pixel, light in dark, to be seen on any ground.
void draw_mark(const Ui& ui, const PicturePlace& place, glm::ivec2 pixel) {
  const float half = std::max(0.5f * place.scale, ui.px(4.0f));
  const float x = place.x + (float(pixel.x) + 0.5f) * place.scale;
  const float y = place.y + (float(pixel.y) + 0.5f) * place.scale;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRect({x - half - 1, y - half - 1}, {x + half + 1, y + half + 1}, IM_COL32(0, 0, 0, 230),
               0.0f, 0, ui.px(3.0f));
  list.AddRect({x - half - 1, y - half - 1}, {x + half + 1, y + half + 1},
               IM_COL32(255, 255, 255, 255), 0.0f, 0, std::max(1.0f, ui.px(1.2f)));
}

/// Where what the scene was loaded for goes wrong.
void draw_region(const LabFrame& frame, const PicturePlace& place, const DisplayImage& image) {
  if (!frame.state.failure) {
    return;
  }
  const PicturePart& region = frame.state.failure->region;
  const auto corner = [&](double x, double y) {
    return ImVec2(place.x + float(x) * place.scale * float(image.width()),
                  place.y + float(y) * place.scale * float(image.height()));
  };
  ImGui::GetWindowDrawList()->AddRect(corner(region.left, region.top),
                                      corner(region.right, region.bottom),
                                      with_alpha(palette::text, 0.6f));
}

/// The numbers themselves, once a pixel is large enough to hold them.
void draw_numbers(LabFrame& frame, const PictureSlot& slot, const PicturePlace& place,
                  const DisplayImage& image) {
  const float line = font_size(frame.ui.small);
  if (place.scale < 3.6f * line) {
    return;
  }
  const SlotChoice choice = shown_choice(frame.state, slot);
  ViewSettings settings = frame.state.view;
  settings.other = choice.other;
  const auto first = [&](float edge, float origin) {
    return std::max(0, int(std::floor((edge - origin) / place.scale)));
  };
  const int x1 = std::min(image.width() - 1, first(slot.box.right(), place.x));
  const int y1 = std::min(image.height() - 1, first(slot.box.bottom(), place.y));
  for (int y = first(slot.box.y, place.y); y <= y1; ++y) {
    for (int x = first(slot.box.x, place.x); x <= x1; ++x) {
      const std::size_t pixel =
          std::size_t(y) * std::size_t(frame.snapshot->width) + std::size_t(x);
      const std::vector<std::string> lines =
          pixel_lines(*frame.snapshot, slot.source, choice.kind, settings, pixel);
      const Rgba8 ground = image.at(x, y);
      const bool light = 2 * ground.r + 5 * ground.g + ground.b > 8 * 110;
      const ImU32 color = light ? IM_COL32(0, 0, 0, 255) : IM_COL32(255, 255, 255, 255);
      float at = place.y + (float(y) + 0.5f) * place.scale - 0.5f * line * float(lines.size());
      for (const std::string& text : lines) {
        text_at(frame.ui.small,
                place.x + (float(x) + 0.5f) * place.scale - 0.5f * text_width(frame.ui.small, text),
                at, color, text);
        at += line;
      }
    }
  }
}

/// Mouse on the picture: pan, zoom, pick, camera.
void handle_mouse(LabFrame& frame, const PictureSlot& slot, int width, int height) {
  LabState& state = frame.state;
  ImGui::SetCursorScreenPos({slot.box.x, slot.box.y});
  invisible_button(slot_name(slot), {slot.box.width, slot.box.height},
                   ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  frame.ui.mark(slot_name(slot));
  if (width == 0 || height == 0) {
    return;
  }
  const ImGuiIO& io = ImGui::GetIO();
  const PicturePlace place = place_picture(state.pan_zoom, slot.box, width, height);
  if (ImGui::IsItemHovered()) {
    const auto pixel = place.pixel_at(io.MousePos.x, io.MousePos.y, width, height);
    frame.hovered = pixel;
    if (io.MouseWheel != 0.0f) {
      if (io.KeyCtrl) {
        Camera& camera = state.request.store.settings.camera;
        camera = dolly(state.camera, camera, io.MouseWheel);
      } else {
        state.pan_zoom = zoomed_at(state.pan_zoom, slot.box, width, height, io.MousePos.x,
                                   io.MousePos.y, std::pow(1.2f, io.MouseWheel));
      }
    }
    if (ImGui::IsMouseDoubleClicked(0)) {
      state.pan_zoom = {};
    }
    const float way = std::sqrt(io.MouseDragMaxDistanceSqr[0]);
    if (ImGui::IsMouseReleased(0) && way < frame.ui.px(3.0f)) {
      state.pinned = state.pinned == pixel ? std::nullopt : pixel;
    }
  }
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    if (ImGui::IsMouseDragging(0, frame.ui.px(3.0f))) {
      state.pan_zoom =
          panned(state.pan_zoom, slot.box, width, height, io.MouseDelta.x, io.MouseDelta.y);
    } else if (ImGui::IsMouseDown(1)) {
      const float turn = 0.008f / frame.ui.scale;
      Camera& camera = state.request.store.settings.camera;
      camera = orbit(state.camera, camera, -io.MouseDelta.x * turn, io.MouseDelta.y * turn);
    }
  }
}

/// The ground of a slot where its picture leaves it free: to fill what a picture covers would be a
/// third of a frame's cost where no graphics card draws.
void draw_well(const LabFrame& frame, const ScreenRect& box, const View* picture) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ScreenRect rest = box;
  const auto fill = [&](const ScreenRect& strip) {
    if (strip.width > 0.0f && strip.height > 0.0f) {
      list.AddRectFilled({strip.x, strip.y}, {strip.right(), strip.bottom()}, palette::well);
    }
  };
  if (picture) {
    const DisplayImage& image = picture->image;
    const PicturePlace place =
        place_picture(frame.state.pan_zoom, box, image.width(), image.height());
    // A pixel of overlap, because the picture's edge may lie between two.
    fill(rest.cut_top(std::ceil(place.y - rest.y) + 1.0f));
    fill(rest.cut_bottom(std::ceil(rest.bottom() - place.y - place.scale * float(image.height())) +
                         1.0f));
    fill(rest.cut_left(std::ceil(place.x - rest.x) + 1.0f));
    fill(rest.cut_right(std::ceil(rest.right() - place.x - place.scale * float(image.width())) +
                        1.0f));
  } else {
    fill(rest);
  }
}

/// Everything of a slot that lies on the picture, clipped to `clip`.
void draw_pixels(LabFrame& frame, const PictureSlot& slot, const View* picture,
                 const ScreenRect& clip) {
  const Ui& ui = frame.ui;
  ImGui::PushClipRect({clip.x, clip.y}, {clip.right(), clip.bottom()}, true);
  if (!picture) {
    draw_note(ui, slot.box,
              frame.loading                      ? "loading the scene"
              : !frame.state.request.store.scene ? "no scene is loaded"
              : frame.status.error.empty()       ? "waiting for the first pass"
                                                 : "nothing was rendered");
  } else if (picture->image.empty()) {
    draw_note(ui, slot.box, picture->note);
  } else {
    const DisplayImage& image = picture->image;
    const PicturePlace place =
        place_picture(frame.state.pan_zoom, slot.box, image.width(), image.height());
    draw_texture(frame, slot.texture, image, place);
    draw_numbers(frame, slot, place, image);
    draw_region(frame, place, image);
    if (!picture->note.empty()) {
      badge(ui, slot.box.x + ui.px(5.0f), slot.box.bottom() - ui.px(22.0f), palette::dim,
            picture->note);
    }
    for (const auto& pixel : {frame.state.pinned, frame.state.hovered}) {
      if (pixel && pixel->x < image.width() && pixel->y < image.height()) {
        draw_mark(ui, place, *pixel);
      }
    }
  }
  ImGui::PopClipRect();
}

}  // namespace

SlotChoice shown_choice(const LabState& state, const PictureSlot& slot) {
  const SlotChoice& choice = state.slots[slot.lane][slot.slot];
  return state.hold_reference && choice.kind == ViewKind::image ? SlotChoice{ViewKind::reference, 0}
                                                                : choice;
}

std::string slot_name(const PictureSlot& slot) {
  return fmt::format("lane{}.slot{}", slot.lane, slot.slot);
}

void draw_picture_slot(LabFrame& frame, const PictureSlot& slot) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const View* picture =
      frame.pictures.get(slot.texture, frame, slot.source, shown_choice(frame.state, slot));
  // What is submitted first has the mouse first, what is drawn last lies on top: so two channels.
  list.ChannelsSplit(2);
  list.ChannelsSetCurrent(1);
  SlotChoice edited = choice_of(frame.state, slot);
  if (edit_choice(frame.ui, slot, edited)) {
    choice_of(frame.state, slot) = edited;
  }
  if (shown_choice(frame.state, slot) != choice_of(frame.state, slot)) {
    badge(frame.ui, slot.box.x + frame.ui.px(5.0f), slot.box.y + frame.ui.px(28.0f), palette::text,
          frame.snapshot && frame.snapshot->reference ? "reference" : "there is no reference");
  } else if (slot.source != slot.lane) {
    badge(frame.ui, slot.box.x + frame.ui.px(5.0f), slot.box.y + frame.ui.px(28.0f),
          frame.lane_color(slot.source), fmt::format("lane {}", slot.source + 1));
  }
  list.ChannelsSetCurrent(0);
  const bool drawn = picture && !picture->image.empty();
  handle_mouse(frame, slot, drawn ? picture->image.width() : 0,
               drawn ? picture->image.height() : 0);
  draw_well(frame, slot.box, drawn ? picture : nullptr);
  draw_pixels(frame, slot, picture, slot.box);
  if (const auto pixel = read_out_pixel(frame.state, frame.snapshot);
      slot.read_out && drawn && pixel) {
    draw_read_out(frame, slot, *pixel);
  }
  list.ChannelsMerge();
}

void draw_wipe_slot(LabFrame& frame, const PictureSlot& a, const PictureSlot& b) {
  Comparison& comparison = frame.state.comparison;
  const float half = frame.ui.px(7.0f);
  const float width = std::max(1.0f, a.box.width);
  float line = a.box.x + comparison.wipe_at * width;
  ImGui::SetCursorScreenPos({line - half, a.box.y + frame.ui.px(30.0f)});
  invisible_button("wipe", {2 * half, a.box.height - frame.ui.px(60.0f)});
  frame.ui.mark("wipe");
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (lit) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  }
  if (ImGui::IsItemActive()) {
    comparison.wipe_at = std::clamp((ImGui::GetIO().MousePos.x - a.box.x) / width, 0.02f, 0.98f);
    line = a.box.x + comparison.wipe_at * width;
  }
  PictureSlot left_of_line = a;
  left_of_line.read_out = false;
  draw_picture_slot(frame, left_of_line);
  const View* picture =
      frame.pictures.get(b.texture, frame, b.source, shown_choice(frame.state, a));
  const ScreenRect right{line, a.box.y, a.box.right() - line, a.box.height};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (picture) {
    list.AddRectFilled({right.x, right.y}, {right.right(), right.bottom()}, palette::well);
    PictureSlot right_of_line = a;
    right_of_line.source = b.source;
    right_of_line.texture = b.texture;
    draw_pixels(frame, right_of_line, picture, right);
  }
  list.AddLine({line, a.box.y}, {line, a.box.bottom()}, IM_COL32(255, 255, 255, lit ? 255 : 200),
               frame.ui.px(lit ? 2.5f : 1.5f));
  if (const auto pixel = read_out_pixel(frame.state, frame.snapshot); picture && pixel) {
    draw_wipe_read_out(frame, a, b, *pixel);
  }
  const float y = a.box.y + frame.ui.px(6.0f);
  badge(frame.ui, line + frame.ui.px(6.0f), y, frame.lane_color(b.source),
        fmt::format("B: lane {}", b.source + 1));
  const std::string left = fmt::format("A: lane {}", a.source + 1);
  badge(frame.ui, line - frame.ui.px(16.0f) - text_width(frame.ui.small, left), y,
        frame.lane_color(a.source), left);
}

}  // namespace quartet
