#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "ui/widgets/screen_rect.h"

namespace quartet {

/// Which part of a picture is seen. One for all pictures, so that they stay aligned whatever their
/// slots' sizes.
struct PanZoom {
  float zoom = 1.0f;       ///< 1: the whole picture fits
  glm::vec2 center{0.5f};  ///< of what is seen, in parts of the picture
  bool operator==(const PanZoom&) const = default;
};

/// Where a picture lies in a slot.
struct PicturePlace {
  float x = 0, y = 0;  ///< of the picture's corner, on screen; may lie outside of the slot
  float scale = 1;     ///< screen pixels for one of the picture

  std::optional<glm::ivec2> pixel_at(float sx, float sy, int width, int height) const {
    const float px = std::floor((sx - x) / scale);
    const float py = std::floor((sy - y) / scale);
    // Also of a slot without room, where they are no numbers.
    if (!(px >= 0.0f && py >= 0.0f && px < float(width) && py < float(height))) {
      return std::nullopt;
    }
    return glm::ivec2(int(px), int(py));
  }
};

inline PicturePlace place_picture(const PanZoom& view, const ScreenRect& slot, int width,
                                  int height) {
  const float fit = std::min(slot.width / float(width), slot.height / float(height));
  PicturePlace place;
  place.scale = fit * view.zoom;
  place.x = slot.center_x() - view.center.x * place.scale * float(width);
  place.y = slot.center_y() - view.center.y * place.scale * float(height);
  return place;
}

/// Zooms by a factor while the point of the picture under (sx, sy) stays where it is.
inline PanZoom zoomed_at(const PanZoom& view, const ScreenRect& slot, int width, int height,
                         float sx, float sy, float factor) {
  const PicturePlace before = place_picture(view, slot, width, height);
  if (!(before.scale > 0.0f)) {
    return view;  // a slot without room
  }
  PanZoom result = view;
  // Until about four pixels fill a slot.
  const float largest = std::max(1.0f, float(std::max(width, height)) / 4.0f);
  result.zoom = std::clamp(view.zoom * factor, 0.25f, largest);
  const float scale = before.scale * result.zoom / view.zoom;
  const glm::vec2 at((sx - before.x) / before.scale, (sy - before.y) / before.scale);
  const glm::vec2 size{float(width), float(height)};
  result.center =
      (at + (glm::vec2(slot.center_x(), slot.center_y()) - glm::vec2(sx, sy)) / scale) / size;
  result.center = glm::clamp(result.center, glm::vec2(0.0f), glm::vec2(1.0f));
  return result;
}

/// Moves the picture by screen pixels.
inline PanZoom panned(const PanZoom& view, const ScreenRect& slot, int width, int height, float dx,
                      float dy) {
  const float scale = place_picture(view, slot, width, height).scale;
  if (!(scale > 0.0f)) {
    return view;  // a slot without room
  }
  PanZoom result = view;
  result.center -= glm::vec2(dx / (scale * float(width)), dy / (scale * float(height)));
  result.center = glm::clamp(result.center, glm::vec2(0.0f), glm::vec2(1.0f));
  return result;
}

}  // namespace quartet
