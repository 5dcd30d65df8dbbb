#pragma once

#include <array>

namespace quartet {

/// The means of one row of a picture by channel, from its first pixel on.
using MeanRow = std::array<const float*, 3>;

/// Where the errors of one row go, by the estimator's channels.
using ErrorRow = std::array<float*, 3>;

/// A row of a picture, as reduced by a WindowKernel, and its neighbours: null beyond the border.
struct WindowRows {
  const float* above;
  const float* here;
  const float* below;
};

/// How an estimator compares the mean of each pixel with those of the 3 × 3 pixels around it, a row
/// at a time: of a film that is there, or of the passes of a replay, of which no film is kept.
struct WindowKernel {
  int values;  ///< floats that a pixel of a reduced row takes
  /// Works out what the three windows above one another that a row is part of have in common;
  /// `reduced` is `values` × `width` floats.
  void (*reduce)(const MeanRow& means, int width, float* reduced);
  void (*errors)(const WindowRows& rows, int width, const ErrorRow& error);
};

}  // namespace quartet
