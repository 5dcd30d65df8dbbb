#pragma once

#include <algorithm>

namespace quartet {

/// A rectangle of the window, in pixels from the top left.
struct ScreenRect {
  float x = 0, y = 0, width = 0, height = 0;

  float right() const { return x + width; }
  float bottom() const { return y + height; }
  float center_x() const { return x + 0.5f * width; }
  float center_y() const { return y + 0.5f * height; }
  bool contains(float px, float py) const {
    return px >= x && px < right() && py >= y && py < bottom();
  }

  /// Cuts a strip off and returns it.
  ScreenRect cut_top(float size) {
    size = std::clamp(size, 0.0f, std::max(0.0f, height));
    const ScreenRect strip{x, y, width, size};
    y += size;
    height -= size;
    return strip;
  }
  ScreenRect cut_bottom(float size) {
    size = std::clamp(size, 0.0f, std::max(0.0f, height));
    height -= size;
    return {x, bottom(), width, size};
  }
  ScreenRect cut_left(float size) {
    size = std::clamp(size, 0.0f, std::max(0.0f, width));
    const ScreenRect strip{x, y, size, height};
    x += size;
    width -= size;
    return strip;
  }
  ScreenRect cut_right(float size) {
    size = std::clamp(size, 0.0f, std::max(0.0f, width));
    width -= size;
    return {right(), y, size, height};
  }
  ScreenRect inset(float dx, float dy) const {
    return {x + dx, y + dy, std::max(0.0f, width - 2 * dx), std::max(0.0f, height - 2 * dy)};
  }
  ScreenRect inset(float d) const { return inset(d, d); }
  bool operator==(const ScreenRect&) const = default;
};

}  // namespace quartet
