#pragma once

#include <optional>
#include <string>

#include "renderer/view/chart.h"
#include "ui/widgets/theme.h"

namespace quartet {

struct MarkerDrag {
  int id;        ///< of the marker
  double value;  ///< where the mouse has taken it
};

/// Paints a chart on screen: title and axis names above, ticks, readings under the mouse. Returns
/// the marker that is being dragged.
std::optional<MarkerDrag> paint_chart(Ui& ui, const std::string& name, const Chart& chart,
                                      const ScreenRect& box);

/// The part of the box between the axes.
ScreenRect chart_area(const Ui& ui, const ScreenRect& box);

ImU32 screen_color(Rgba8 color);
/// The other way, opaque.
Rgba8 rgba_of(ImU32 color);

}  // namespace quartet
