#pragma once

#include <variant>

#include "renderer/scene/lights/point_light.h"

namespace quartet {

/// The kinds of light without extent, one file each: no ray meets them. A kind says what it is
/// called in scene files (name), whether it shines at all (shines), its power in units of radiance
/// times area (power), what it is to people (text), and how it is hashed (add_to), read (read)
/// and written (write).
using DeltaLight = std::variant<PointLight>;

}  // namespace quartet
