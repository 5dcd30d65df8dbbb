#pragma once

#include <glm/glm.hpp>
#include <string>

namespace quartet {

/// Four significant digits, no trailing zeros: 71, 0.005, 31.27, 2.5e7.
std::string format_number(double value);

/// In at most about six characters: 0.412, 31.3, 1.2e+04.
std::string short_number(float value);

/// Four significant digits each, one number alone if all three are equal: "0.5", "1 0.25 0".
std::string vector_text(glm::vec3 v);

}  // namespace quartet
