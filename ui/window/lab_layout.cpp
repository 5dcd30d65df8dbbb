#include "ui/window/lab_layout.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/table.h"
#include "ui/window/lane_header.h"

namespace quartet {
namespace {

constexpr float gap = 6.0f;
constexpr float lane_margin = 8.0f;
constexpr float least_chart = 62.0f;
constexpr float top_line = 3.0f;  // in the lane's colour

constexpr std::array layout_table{
    LayoutRow{LabLayout::columns, "columns", "columns"},
    LayoutRow{LabLayout::grid, "grid", "2 × 2"},
    LayoutRow{LabLayout::large, "large", "one large"},
};

ScreenRect rounded(const ScreenRect& box) {
  const float x = std::round(box.x);
  const float y = std::round(box.y);
  return {x, y, std::round(box.right()) - x, std::round(box.bottom()) - y};
}

ScreenRect inside(const Ui& ui, ScreenRect panel) {
  panel.cut_top(ui.px(top_line));
  return panel.inset(ui.px(lane_margin), ui.px(lane_margin));
}

float charts_height(const Ui& ui, std::size_t count) {
  return float(count) * ui.px(least_chart) + float(count - 1) * ui.px(gap);
}

/// Charts below each other, in what is left; those beyond `count` get no room.
void stack_charts(const Ui& ui, ScreenRect box, ColumnLayout& layout, std::size_t count = 3) {
  const float each = (box.height - float(count - 1) * ui.px(gap)) / float(count);
  for (std::size_t i = 0; i < count; ++i) {
    layout.charts[i] = rounded(box.cut_top(each));
    box.cut_top(ui.px(gap));
  }
}

}  // namespace

std::span<const LayoutRow> layouts() {
  return layout_table;
}

const LayoutRow& layout_row(LabLayout key) {
  return row_of(layouts(), key);
}

const LayoutRow& find_layout(std::string_view id) {
  return find_row(layouts(), id, "layout");
}

ColumnLayout lay_out_column(const Ui& ui, const ScreenRect& panel, const ColumnWish& wish) {
  ColumnLayout layout;
  layout.panel = panel;
  ScreenRect box = inside(ui, panel);
  layout.header = box.cut_top(lane_header_height(ui, box.width));
  box.cut_top(ui.px(4.0f));
  const float keys = wish.key_heights[0] + wish.key_heights[1];
  // Pictures come first: the last charts give way before a picture shrinks by much.
  std::size_t charts = layout.charts.size();
  const auto picture_height = [&] {
    const float room = box.height - keys - charts_height(ui, charts) - 2 * ui.px(gap);
    return std::min(box.width / wish.aspect, 0.5f * room);
  };
  while (charts > 1 && picture_height() < 0.6f * box.width / wish.aspect) {
    --charts;
  }
  const float picture = std::max(ui.px(40.0f), picture_height());
  for (std::size_t slot = 0; slot < 2; ++slot) {
    layout.pictures[slot] = rounded(box.cut_top(picture));
    layout.keys[slot] = box.cut_top(wish.key_heights[slot]);
    box.cut_top(ui.px(gap));
  }
  stack_charts(ui, box, layout, charts);
  return layout;
}

ColumnLayout lay_out_cell(const Ui& ui, const ScreenRect& panel, const ColumnWish& wish) {
  ColumnLayout layout;
  layout.panel = panel;
  ScreenRect box = inside(ui, panel);
  layout.header = box.cut_top(lane_header_height(ui, box.width));
  box.cut_top(ui.px(2.0f));
  const float key = std::max(wish.key_heights[0], wish.key_heights[1]);
  const float half = 0.5f * (box.width - ui.px(gap));
  const float room = box.height - key - ui.px(gap) - ui.px(least_chart);
  const float picture = std::max(ui.px(40.0f), std::min(half / wish.aspect, room));
  ScreenRect pictures = box.cut_top(picture);
  layout.pictures = {rounded(pictures.cut_left(half)), rounded(pictures.cut_right(half))};
  ScreenRect keys = box.cut_top(key);
  layout.keys = {keys.cut_left(half), keys.cut_right(half)};
  box.cut_top(ui.px(gap));
  const float each = (box.width - 4 * ui.px(gap)) / 3.0f;
  for (ScreenRect& chart : layout.charts) {
    chart = rounded(box.cut_left(each));
    box.cut_left(2 * ui.px(gap));
  }
  return layout;
}

ColumnLayout lay_out_large(const Ui& ui, const ScreenRect& area, const ColumnWish& wish) {
  ColumnLayout layout;
  layout.panel = area;
  ScreenRect box = inside(ui, area);
  const float side = std::clamp(0.25f * area.width, ui.px(300.0f), ui.px(460.0f));
  ScreenRect left = box.cut_left(side);
  box.cut_left(ui.px(lane_margin));
  layout.header = left.cut_top(lane_header_height(ui, left.width));
  left.cut_top(ui.px(4.0f));
  const float charts = charts_height(ui, layout.charts.size());
  layout.pictures[1] = rounded(
      left.cut_top(std::min(left.width / wish.aspect, left.height - wish.key_heights[1] - charts)));
  layout.keys[1] = left.cut_top(wish.key_heights[1]);
  left.cut_top(ui.px(gap));
  stack_charts(ui, left, layout);
  layout.keys[0] = box.cut_bottom(wish.key_heights[0]);
  layout.pictures[0] = rounded(box);
  return layout;
}

std::vector<ScreenRect> lane_panels(const Ui& ui, const ScreenRect& area, LabLayout layout,
                                    std::size_t count) {
  if (layout == LabLayout::large || count <= 1) {
    return {area};
  }
  const std::size_t columns = layout == LabLayout::grid ? 2 : count;
  const std::size_t rows = (count + columns - 1) / columns;
  const float between = ui.px(gap);
  // Whole pixels, and as many in each, so that their pictures are of one size.
  const float width = std::floor((area.width - float(columns - 1) * between) / float(columns));
  const float height = std::floor((area.height - float(rows - 1) * between) / float(rows));
  std::vector<ScreenRect> panels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / columns;
    const std::size_t column = i % columns;
    panels.push_back(rounded({area.x + float(column) * (width + between),
                              area.y + float(row) * (height + between), width, height}));
  }
  return panels;
}

}  // namespace quartet
