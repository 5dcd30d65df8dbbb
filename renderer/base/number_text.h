#pragma once

#include <string>

namespace quartet {

/// Four significant digits, no trailing zeros: 71, 0.005, 31.27, 2.5e7.
std::string format_number(double value);

}  // namespace quartet
