#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace quartet {

/// Doubles that round to `floats` and are as `project` makes them, such as of length 1. A scene
/// keeps floats of what its file said in doubles; a file that is read to the same floats must say
/// such doubles again, because reading normalises what rounding has made a little too long. They
/// are found by going to and fro between both conditions (projections onto convex sets, which these
/// are nearly: Bauschke and Borwein, SIAM Review 38(3), 1996). If there are none, as for floats
/// that no file gave, what `project` makes of the floats, which is next to them.
template <std::size_t count, class Project>
std::array<double, count> rounded_to(const std::array<float, count>& floats,
                                     const Project& project) {
  constexpr int rounds = 1000;
  constexpr double inside = 0.49;  // of the way to the next float: at half of it rounding changes
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<double, count> start;
  std::ranges::copy(floats, start.begin());
  std::array<double, count> values = start;
  for (int round = 0; round < rounds; ++round) {
    project(values);
    bool right = true;
    for (std::size_t i = 0; i < count; ++i) {
      right = right && float(values[i]) == floats[i];
    }
    if (right) return values;
    for (std::size_t i = 0; i < count; ++i) {
      const double low = double(std::nextafter(floats[i], -infinity));
      const double high = double(std::nextafter(floats[i], infinity));
      values[i] = std::clamp(values[i], start[i] - inside * (start[i] - low),
                             start[i] + inside * (high - start[i]));
    }
  }
  project(start);
  return start;
}

}  // namespace quartet
