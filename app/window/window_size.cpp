#include "app/window/window_size.h"

#include <algorithm>
#include <cmath>

namespace quartet {

WindowSize fitting_window(const WindowSize& wanted, float scale, const WindowSize& area) {
  const auto side = [scale](int length, int room) {
    const int scaled = std::max(1, int(std::lround(float(length) * scale)));
    return room > 0 ? std::min(scaled, room) : scaled;
  };
  return {side(wanted.width, area.width), side(wanted.height, area.height)};
}

WindowSize remembered_window(const WindowSize& size, float scale) {
  return {int(std::lround(float(size.width) / scale)),
          int(std::lround(float(size.height) / scale))};
}

}  // namespace quartet
