#include "ui/widgets/chart_painter.h"
#include "renderer/base/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"

namespace quartet {
namespace {

/// From the axes' numbers to the screen.
struct Mapping {
  const Chart& chart;
  ScreenRect area;

  float x(double value) const { return area.x + float(axis_position(chart.x, value)) * area.width; }
  float y(double value) const {
    return area.bottom() - float(axis_position(chart.y, value)) * area.height;
  }
  double position(float sx) const { return double((sx - area.x) / area.width); }
};

constexpr float marker_head = 5.0f;  // half of its width

/// In a low chart texts would cover the data: the one at the right goes up into the title's line.
bool is_low(const Ui& ui, const ScreenRect& area) {
  return area.height < ui.px(52.0f);
}

/// "pixels by error" over "error (contrast)" is "pixels by error (contrast)".
std::string title_with_unit(const Chart& chart) {
  const std::size_t unit = chart.x.label.find(" (");
  return unit == std::string::npos ? chart.title : chart.title + chart.x.label.substr(unit);
}

void draw_titles(const Ui& ui, const Chart& chart, const ScreenRect& box, bool low) {
  const float title = text_width(ui.small, chart.title) + ui.px(8.0f);
  const float room = box.width - title;
  const auto text = std::ranges::find(chart.texts, Align::right, &ChartText::align);
  if (low && text != chart.texts.end()) {
    text_left_of(ui.small, box.right(), box.y, screen_color(text->color), text->text);
    const float left = box.width - text_width(ui.small, text->text) - ui.px(8.0f);
    text_at(ui.small, box.x, box.y, palette::text,
            fitting_text(ui.small, {title_with_unit(chart), chart.title, ""}, left));
    return;
  }
  text_at(ui.small, box.x, box.y, palette::text, chart.title);
  const std::string both = chart.y.label + "  over  " + chart.x.label;
  text_left_of(ui.small, box.right(), box.y, palette::dim,
               fitting_text(ui.small, {both, chart.x.label, ""}, room));
}

/// Ticks with their numbers; a number that would touch the one before is left out.
void draw_ticks(const Ui& ui, const Mapping& map, const ScreenRect& box) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ScreenRect& area = map.area;
  float taken = -1e9f;
  for (const Tick& tick : map.chart.x.ticks) {
    const float x = std::round(map.x(tick.value));
    const float width = text_width(ui.small, tick.label);
    const float left = std::clamp(x - 0.5f * width, area.x, std::max(area.x, box.right() - width));
    if (x > area.x + 1 && x < area.right() - 1) {
      list.AddLine({x, area.y}, {x, area.bottom()}, IM_COL32(255, 255, 255, 14));
    }
    if (left >= taken) {
      text_at(ui.small, left, area.bottom() + ui.px(1.0f), palette::dim, tick.label);
      taken = left + width + ui.px(6.0f);
    }
  }
  float above = 1e9f;
  const float line = font_size(ui.small);
  for (const Tick& tick : map.chart.y.ticks) {
    const float y = std::round(map.y(tick.value));
    if (y < area.y || y > area.bottom()) {
      continue;
    }
    if (y < area.bottom() - 1 && y > area.y + 1) {
      list.AddLine({area.x, y}, {area.right(), y}, IM_COL32(255, 255, 255, 14));
    }
    const float highest = area.y - ui.px(2.0f);
    const float top =
        std::clamp(y - 0.5f * line, highest, std::max(highest, area.bottom() - line + ui.px(4.0f)));
    if (top + line <= above) {
      text_left_of(ui.small, area.x - ui.px(4.0f), top, palette::dim, tick.label);
      above = top;
    }
  }
}

/// Lengths of dash and gap in turn, in the window's own pixels; none: solid.
std::vector<float> dash_lengths(const Ui& ui, Dash dash) {
  switch (dash) {
    case Dash::solid:
      break;
    case Dash::dashed:
      return {ui.px(5.0f), ui.px(3.0f)};
    case Dash::dash_dot:
      return {ui.px(7.0f), ui.px(3.0f), ui.px(2.0f), ui.px(3.0f)};
    case Dash::dotted:
      return {ui.px(2.0f), ui.px(3.0f)};
  }
  return {};
}

/// Dashes along a polyline, which go on around its corners.
void draw_dashes(const Ui& ui, const std::vector<ImVec2>& points, ImU32 color, Dash dash) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::vector<float> lengths = dash_lengths(ui, dash);
  constexpr float longest = 1e5f;  // one end lies nowhere on a logarithmic axis
  std::size_t part = 0;            // of the pattern: dashes are even
  float left = lengths.front();    // of it
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const ImVec2 a = points[i];
    const ImVec2 b = points[i + 1];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length < longest)) {
      continue;
    }
    const auto at = [&](float way) {
      return ImVec2(a.x + (b.x - a.x) * way / length, a.y + (b.y - a.y) * way / length);
    };
    for (float way = 0.0f; way < length;) {
      const float end = std::min(way + left, length);
      if (part % 2 == 0) {
        list.AddLine(at(way), at(end), color, ui.px(1.5f));
      }
      left -= end - way;
      way = end;
      if (left <= 0.01f) {  // so that far ends move on, too
        part = (part + 1) % lengths.size();
        left = lengths[part];
      }
    }
  }
}

void draw_shape(const Ui& ui, ImVec2 at, MarkShape shape, float r, ImU32 color) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  switch (shape) {
    case MarkShape::dot:
      list.AddCircleFilled(at, r, color);
      break;
    case MarkShape::square:
      list.AddRectFilled({at.x - 0.9f * r, at.y - 0.9f * r}, {at.x + 0.9f * r, at.y + 0.9f * r},
                         color);
      break;
    case MarkShape::triangle:
      list.AddTriangleFilled({at.x, at.y - 1.2f * r}, {at.x + 1.1f * r, at.y + 0.9f * r},
                             {at.x - 1.1f * r, at.y + 0.9f * r}, color);
      break;
    case MarkShape::wedge:
      list.AddTriangleFilled({at.x, at.y + 1.2f * r}, {at.x + 1.1f * r, at.y - 0.9f * r},
                             {at.x - 1.1f * r, at.y - 0.9f * r}, color);
      break;
    case MarkShape::diamond:
      list.AddQuadFilled({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y},
                         color);
      break;
    case MarkShape::cross:
      list.AddLine({at.x - r, at.y - r}, {at.x + r, at.y + r}, color, ui.px(1.5f));
      list.AddLine({at.x - r, at.y + r}, {at.x + r, at.y - r}, color, ui.px(1.5f));
      break;
  }
}

void draw_data(const Ui& ui, const Mapping& map) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ScreenRect& area = map.area;
  const auto clamped = [&](double value) { return std::clamp(map.x(value), area.x, area.right()); };
  for (const Shade& shade : map.chart.shades) {
    list.AddRectFilled({clamped(shade.begin), area.y}, {clamped(shade.end), area.bottom()},
                       screen_color(shade.color));
  }
  for (const Bar& bar : map.chart.bars) {
    const float left = clamped(bar.begin);
    const float right = clamped(bar.end);
    const float top = std::max(area.y, map.y(bar.value));
    // A hairline between bars as soon as they are wide enough to spare it.
    const float gap = right - left > 4.0f ? 1.0f : 0.0f;
    if (top < area.bottom() && right > left) {
      list.AddRectFilled({left, top}, {right - gap, area.bottom()}, screen_color(bar.color));
    }
  }
  for (const Band& band : map.chart.bands) {
    for (std::size_t i = 0; i + 1 < band.lower.size(); ++i) {
      const auto at = [&](const glm::dvec2& p) { return ImVec2(map.x(p.x), map.y(p.y)); };
      list.AddQuadFilled(at(band.lower[i]), at(band.lower[i + 1]), at(band.upper[i + 1]),
                         at(band.upper[i]), screen_color(band.color));
    }
  }
  for (const Level& level : map.chart.levels) {
    const float y = map.y(level.value);
    draw_dashes(ui, {{area.x, y}, {area.right(), y}}, screen_color(level.color), Dash::dashed);
    text_at(ui.small, area.x + ui.px(4.0f), y - font_size(ui.small) - ui.px(2.0f),
            screen_color(level.color), level.label);
  }
  std::vector<ImVec2> points;
  for (const Line& line : map.chart.lines) {
    const ImU32 color = screen_color(line.color);
    points.clear();
    for (const glm::dvec2& point : line.points) {
      points.emplace_back(map.x(point.x), map.y(point.y));
    }
    if (line.dash != Dash::solid) {
      draw_dashes(ui, points, color, line.dash);
    } else {
      list.AddPolyline(points.data(), int(points.size()), color, 0, ui.px(1.5f * line.width));
    }
    if (line.dots) {
      for (const ImVec2& point : points) {
        draw_shape(ui, point, line.shape, ui.px(2.5f), color);
      }
    }
  }
  for (const PointMark& mark : map.chart.marks) {
    draw_shape(ui, {map.x(mark.at.x), map.y(mark.at.y)}, mark.shape, ui.px(4.5f),
               screen_color(mark.color));
  }
}

void draw_texts(const Ui& ui, const Mapping& map) {
  const ScreenRect& area = map.area;
  const float below_heads = map.chart.markers.empty() ? 0.0f : ui.px(1.4f * marker_head);
  for (const ChartText& text : map.chart.texts) {
    if (is_low(ui, area) && text.align != Align::center) {
      continue;
    }
    const float width = text_width(ui.small, text.text);
    const float x = area.x + float(text.place.x) * area.width -
                    (text.align == Align::left     ? 0.0f
                     : text.align == Align::center ? 0.5f * width
                                                   : width);
    const float y =
        std::max(area.bottom() - float(text.place.y) * area.height, area.y + below_heads);
    ImGui::GetWindowDrawList()->AddRectFilled({x - ui.px(3.0f), y},
                                              {x + width + ui.px(3.0f), y + font_size(ui.small)},
                                              with_alpha(palette::well, 0.8f), ui.px(2.0f));
    text_at(ui.small, x, y, screen_color(text.color), text.text);
  }
}

void draw_marker(Ui& ui, const std::string& name, const Mapping& map, const Marker& marker,
                 bool lit) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ScreenRect& area = map.area;
  const float x = std::clamp(map.x(marker.value), area.x, area.right());
  const ImU32 color = screen_color(marker.color);
  const float head = ui.px(lit ? marker_head + 1.0f : marker_head);
  list.AddLine({x, area.y}, {x, area.bottom()}, color, ui.px(lit ? 2.5f : 1.5f));
  list.AddTriangleFilled({x - head, area.y}, {x + head, area.y}, {x, area.y + 1.4f * head}, color);
  ui.mark(fmt::format("{}.marker{}", name, marker.id), {x - head, area.y, 2 * head, area.height});
}

}  // namespace

ImU32 screen_color(Rgba8 color) {
  return IM_COL32(color.r, color.g, color.b, color.a);
}

Rgba8 rgba_of(ImU32 color) {
  const auto byte = [&](int shift) { return std::uint8_t(color >> shift); };
  return {byte(IM_COL32_R_SHIFT), byte(IM_COL32_G_SHIFT), byte(IM_COL32_B_SHIFT), 255};
}

ScreenRect chart_area(const Ui& ui, const ScreenRect& box) {
  const float line = font_size(ui.small) + ui.px(3.0f);
  ScreenRect area = box;
  area.cut_top(line);
  area.cut_bottom(line);
  area.cut_left(ui.px(30.0f));
  return area;
}

std::optional<MarkerDrag> paint_chart(Ui& ui, const std::string& name, const Chart& chart,
                                      const ScreenRect& box) {
  const Mapping map{chart, chart_area(ui, box)};
  const ScreenRect& area = map.area;
  if (area.width < 8.0f || area.height < 8.0f) {
    return std::nullopt;
  }
  ImGui::SetCursorScreenPos({area.x, area.y});
  invisible_button(name, {area.width, area.height});
  ui.mark(name);

  constexpr int none = -1;
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(name.c_str());
  const float mouse = ImGui::GetIO().MousePos.x;
  const bool hovered = ImGui::IsItemHovered();
  const Marker* near = marker_near(chart, map.position(mouse), double(ui.px(10.0f) / area.width));
  if (ImGui::IsItemActivated()) {
    storage.SetInt(id, near ? near->id : none);
  }
  const int held = ImGui::IsItemActive() ? storage.GetInt(id, none) : none;

  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({area.x, area.y}, {area.right(), area.bottom()}, palette::well);
  draw_titles(ui, chart, box, is_low(ui, area));
  draw_ticks(ui, map, box);
  ImGui::PushClipRect({area.x, area.y}, {area.right(), area.bottom()}, true);
  draw_data(ui, map);
  for (const Marker& marker : chart.markers) {
    draw_marker(ui, name, map, marker, marker.id == held || (hovered && near == &marker));
  }
  draw_texts(ui, map);
  if (hovered && !near && held == none) {
    list.AddLine({mouse, area.y}, {mouse, area.bottom()}, with_alpha(palette::text, 0.5f));
  }
  ImGui::PopClipRect();

  if (held != none) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    return MarkerDrag{held, axis_value(chart.x, std::clamp(map.position(mouse), 0.0, 1.0))};
  }
  if (hovered && near) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    tooltip(ui,
            fmt::format("{}threshold {}\ndrag to move it",
                        near->label.empty() ? "" : near->label + ": ", format_number(near->value)));
  } else if (hovered) {
    tooltip(ui, reading_at(chart, axis_value(chart.x, map.position(mouse))));
  }
  return std::nullopt;
}

}  // namespace quartet
