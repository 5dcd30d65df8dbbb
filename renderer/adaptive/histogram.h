#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace quartet {

/// How many pixels have how many samples.
struct SampleHistogram {
  static constexpr std::size_t most_bins = 256;

  /// Bin i holds pixels with i · width up to (i + 1) · width samples, the end not included.
  std::uint32_t width = 1;
  std::vector<std::uint32_t> pixels;  ///< up to the last bin with pixels
};

/// How many pixels have which error, in bins that are equally wide on a logarithmic axis. Its edges
/// are good to a hundredth of a bin.
struct ErrorHistogram {
  static constexpr int first_exponent = -9;  ///< of ten, where the first bin begins
  static constexpr int end_exponent = 5;     ///< of ten, where the last bin ends
  static constexpr int bins_per_decade = 12;
  static constexpr int bins = (end_exponent - first_exponent) * bins_per_decade;

  /// Errors outside of all bins are in the outermost ones.
  std::array<std::uint32_t, bins> pixels{};
  std::uint32_t zero = 0;      ///< pixels without error, which have no place on the axis
  std::uint32_t infinite = 0;  ///< nor have those that cannot be judged yet

  static double begin_of(int bin);  ///< where a bin begins; for `bins`, where the last one ends
};

void fill_histogram(std::span<const std::uint32_t> samples, SampleHistogram& histogram);
/// NaN counts as no error.
void fill_histogram(std::span<const float> errors, ErrorHistogram& histogram);

}  // namespace quartet
