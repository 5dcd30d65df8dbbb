#pragma once

#include <variant>

#include "renderer/scene/lights/constant_environment.h"

namespace quartet {

/// The kinds of light from all around, one file each: what a ray finds that meets no shape. A kind
/// says what it is called in scene files (name), whether it shines at all (shines), what arrives
/// against a direction (at), what it is to people (text), and how it is hashed (add_to), read
/// (read) and written (write).
using Environment = std::variant<ConstantEnvironment>;

inline bool shines(const Environment& environment) {
  return std::visit([](const auto& kind) { return kind.shines(); }, environment);
}

}  // namespace quartet
