#pragma once

#include <string>

#include "renderer/view/color_map.h"

namespace quartet {

/// The key of a picture whose colours are numbers: a horizontal bar with ticks and the quantity's
/// name and unit.
struct ColorBar {
  ColorScale scale;
  std::string label;      ///< e.g. "samples per pixel"
  std::string cap_label;  ///< what cap_color means; empty if the pictures have no such pixels
};

}  // namespace quartet
