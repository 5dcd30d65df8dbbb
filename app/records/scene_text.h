#pragma once

#include <array>
#include <string_view>

#include "renderer/scene/scene.h"

namespace quartet {

/// As scene files call it.
inline std::string_view material_name(MaterialKind kind) {
  constexpr std::array<std::string_view, 4> names{"diffuse", "conductor", "roughconductor",
                                                  "dielectric"};
  return names[std::size_t(kind)];
}

}  // namespace quartet
