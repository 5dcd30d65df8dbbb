#include "renderer/adaptive/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/math/fast_log2.h"

namespace quartet {

double ErrorHistogram::begin_of(int bin) {
  return std::pow(10.0, double(first_exponent) + double(bin) / double(bins_per_decade));
}

void fill_histogram(std::span<const std::uint32_t> samples, SampleHistogram& histogram) {
  std::uint32_t most = 0;
  for (const std::uint32_t count : samples) {
    most = std::max(most, count);
  }
  // A power of two: this is done for every picture, and a shift costs less than a division.
  const std::uint32_t last_bin = SampleHistogram::most_bins - 1;
  const int bits = std::max(0, int(std::bit_width(most)) - int(std::bit_width(last_bin)));
  histogram.width = 1u << bits;
  histogram.pixels.assign((most >> bits) + 1, 0);
  for (const std::uint32_t count : samples) {
    ++histogram.pixels[count >> bits];
  }
}

void fill_histogram(std::span<const float> errors, ErrorHistogram& histogram) {
  constexpr auto bins_per_octave =
      float(ErrorHistogram::bins_per_decade * std::numbers::ln2 / std::numbers::ln10);
  constexpr auto first = float(-ErrorHistogram::first_exponent * ErrorHistogram::bins_per_decade);
  // Bin 0 is for no error, the others come after it, and the last is for infinite ones.
  constexpr int not_judged = ErrorHistogram::bins + 1;
  std::array<std::uint32_t, not_judged + 1> pixels{};
  constexpr std::size_t block = 512;
  std::array<std::int32_t, block> places;
  for (std::size_t start = 0; start < errors.size(); start += block) {
    const std::size_t size = std::min(block, errors.size() - start);
    const float* error = errors.data() + start;
#pragma omp simd
    for (std::size_t i = 0; i < size; ++i) {
      float place = fast_log2(error[i]) * bins_per_octave + first;
      place = place > 0.0f ? place : 0.0f;
      place = place < float(ErrorHistogram::bins - 1) ? place : float(ErrorHistogram::bins - 1);
      const std::int32_t bin = error[i] > 0.0f ? std::int32_t(place) + 1 : 0;
      places[i] = error[i] > std::numeric_limits<float>::max() ? not_judged : bin;
    }
    for (std::size_t i = 0; i < size; ++i) {
      ++pixels[std::size_t(places[i])];
    }
  }
  histogram.zero = pixels[0];
  histogram.infinite = pixels[not_judged];
  std::copy_n(pixels.begin() + 1, ErrorHistogram::bins, histogram.pixels.begin());
}

}  // namespace quartet
