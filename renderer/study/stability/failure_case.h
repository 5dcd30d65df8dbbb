#pragma once

#include <span>
#include <string_view>

namespace quartet {

/// A rectangle in shares of the picture, from the top left.
struct PicturePart {
  double left = 0.0, top = 0.0, right = 1.0, bottom = 1.0;
};

/// One row of the table of cases that methods of adaptive sampling fail on, each the smallest that
/// shows its point.
struct FailureCase {
  std::string_view id;
  std::string_view scene;  ///< as open_scene takes it
  std::string_view mode;   ///< what goes wrong, in a few words
  std::string_view watch;  ///< what to look at, one sentence
  PicturePart region;      ///< where it goes wrong
  std::string_view view;   ///< its id: what shows it best beside the picture
  float zoom;              ///< on the middle of the region; 1 shows the whole picture
};

std::span<const FailureCase> failure_cases();
/// Throws std::invalid_argument that lists the legal ids.
const FailureCase& find_failure_case(std::string_view id);

/// The pixels of a region at one resolution, at least one.
struct PixelRegion {
  int left, top, right, bottom;  ///< right and bottom are past the last one
  int pixels() const { return (right - left) * (bottom - top); }
};
PixelRegion pixels_of(const PicturePart& region, int width, int height);

}  // namespace quartet
