#pragma once

namespace quartet {

struct WindowSize {
  int width = 0;
  int height = 0;
  bool operator==(const WindowSize&) const = default;
};

/// The size of a window that opens: `wanted` is that at scale 1, `scale` that of the display's
/// text, and `area` what the screen has room for, zero where that is not known.
WindowSize fitting_window(const WindowSize& wanted, float scale, const WindowSize& area);

/// What to remember of a window at that scale, to open the next one alike.
WindowSize remembered_window(const WindowSize& size, float scale);

}  // namespace quartet
