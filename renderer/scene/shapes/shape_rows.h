#pragma once

#include <array>
#include <string_view>

#include "renderer/scene/shapes/shape.h"

namespace quartet {

class Element;
struct SceneBuilder;

/// A shape as scene files know it; several may be of one kind of geometry.
struct ShapeRow {
  std::string_view type;
  /// Its geometry in the world. Throws SceneError, and Cancelled once the loading was asked to end.
  Geometry (*read)(SceneBuilder& builder, Element& element);
};

// Each is what its file ends in.
extern const ShapeRow rectangle_row;
extern const ShapeRow cube_row;
extern const ShapeRow sphere_row;
extern const ShapeRow disk_row;
extern const ShapeRow obj_row;
inline constexpr std::array shape_rows = {&rectangle_row, &cube_row, &sphere_row, &disk_row,
                                          &obj_row};

}  // namespace quartet
