#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "ui/widgets/theme.h"
#include "ui/window/lab_state.h"

namespace quartet {

/// One row of the table of layouts.
struct LayoutRow {
  LabLayout key;
  std::string_view id;     ///< on the command line and in files
  std::string_view label;  ///< for people
};

std::span<const LayoutRow> layouts();
const LayoutRow& layout_row(LabLayout key);
/// Throws std::invalid_argument that lists the legal ids.
const LayoutRow& find_layout(std::string_view id);

/// Where the parts of a lane's column lie.
struct ColumnLayout {
  ScreenRect panel;
  ScreenRect header;
  std::array<ScreenRect, 2> pictures;
  std::array<ScreenRect, 2> keys;  ///< to the pictures' colours; no height where there is none
  std::array<ScreenRect, 3> charts;
};

struct ColumnWish {
  float aspect = 16.0f / 9.0f;             ///< of the picture
  std::array<float, 2> key_heights{0, 0};  ///< of both slots, equal in all columns
};

/// A column from the top down: header, pictures, plots.
ColumnLayout lay_out_column(const Ui& ui, const ScreenRect& panel, const ColumnWish& wish);
/// The same with the pictures side by side and the plots in a row below.
ColumnLayout lay_out_cell(const Ui& ui, const ScreenRect& panel, const ColumnWish& wish);
/// The lane of the large view: the first picture fills what is right of a column with the rest.
ColumnLayout lay_out_large(const Ui& ui, const ScreenRect& area, const ColumnWish& wish);

/// Panels of `count` lanes in an area, with gaps between them.
std::vector<ScreenRect> lane_panels(const Ui& ui, const ScreenRect& area, LabLayout layout,
                                    std::size_t count);

}  // namespace quartet
