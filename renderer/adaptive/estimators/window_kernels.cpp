#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/base/parallel.h"

namespace quartet {
namespace {

// The criteria of window.h over the 3 × 3 neighbourhood of pixel means around every pixel; at the
// border the window holds the 6 or 4 pixels that exist. Single precision, in forms that keep their
// digits for nearly equal values and are exactly 0 for equal ones.

// Below this mean luminance a reciprocal would leave the range of float; the error, which is
// smaller still, is taken as 0.
constexpr float darkest = 1e-37f;

// What is brighter is taken as this: the sum of the differences of a window would leave it too.
constexpr float brightest = 0x1p120f;

// Rows handed to one thread at a time. Each piece reads the row above and the row below it too.
constexpr std::size_t grain_rows = 16;

/// Lowest and highest of each value and its left and right neighbours.
void row_extremes(const float* row, int width, float* low, float* high) {
  std::copy_n(row, width, low);
  std::copy_n(row, width, high);
#pragma omp simd
  for (int x = 1; x < width; ++x) {
    low[x] = std::min(low[x], row[x - 1]);
    high[x] = std::max(high[x], row[x - 1]);
  }
#pragma omp simd
  for (int x = 0; x < width - 1; ++x) {
    low[x] = std::min(low[x], row[x + 1]);
    high[x] = std::max(high[x], row[x + 1]);
  }
}

/// Rows [begin, end) of one channel.
void contrast_rows(std::span<const float> values, int width, int height, int begin, int end,
                   float* error) {
  // Extremes along the row of the last three rows, so that each row is read once.
  std::vector<float> buffer(std::size_t(width) * 6);
  float* low[3];
  float* high[3];
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = buffer.data() + 2 * i * std::size_t(width);
    high[i] = low[i] + width;
  }
  const auto load = [&](int y) {
    row_extremes(values.data() + std::size_t(y) * std::size_t(width), width, low[y % 3],
                 high[y % 3]);
  };
  load(std::max(begin - 1, 0));
  load(begin);
  for (int y = begin; y < end; ++y) {
    if (y + 1 < height) {
      load(y + 1);
    }
    const int above = std::max(y - 1, 0) % 3;
    const int below = std::min(y + 1, height - 1) % 3;
    const float* low_above = low[above];
    const float* low_here = low[y % 3];
    const float* low_below = low[below];
    const float* high_above = high[above];
    const float* high_here = high[y % 3];
    const float* high_below = high[below];
    float* out = error + std::size_t(y) * std::size_t(width);
#pragma omp simd
    for (int x = 0; x < width; ++x) {
      const float l = std::min(std::min(low_above[x], low_here[x]), low_below[x]);
      const float h = std::max(std::max(high_above[x], high_here[x]), high_below[x]);
      // Half of each, because the sum of two large values leaves the range of float.
      const float sum = 0.5f * h + 0.5f * l;
      out[x] = h > 0.0f ? (0.5f * h - 0.5f * l) / sum : 0.0f;
    }
  }
}

/// Rec. 709 luminances of one row, and what the criterion wants to know of each beforehand.
struct LuminanceRow {
  std::vector<float> luminance, root;

  void load(const Film& film, int y, bool with_root) {
    const auto width = std::size_t(film.width());
    const float* r = film.mean(0).data() + std::size_t(y) * width;
    const float* g = film.mean(1).data() + std::size_t(y) * width;
    const float* b = film.mean(2).data() + std::size_t(y) * width;
    luminance.resize(width);
    float* out = luminance.data();
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
      out[x] = std::min(brightest, quartet::luminance(r[x], g[x], b[x]));
    }
    if (with_root) {
      root.resize(width);
      float* root_out = root.data();
#pragma omp simd
      for (std::size_t x = 0; x < width; ++x) {
        root_out[x] = std::sqrt(out[x]);
      }
    }
  }
};

/// The rows of a window, 1 to 3, and the one with its centre.
template <int Rows>
struct WindowRows {
  const float* luminance[Rows];
  const float* root[Rows];
  const float* centre;
};

/// The mean of a window, with the neighbours' deviations from its centre: differences of nearly
/// equal floats are exact, and the mean of equal values is exactly that value.
struct WindowMean {
  float centre;
  float mean;
  float reciprocal;      // 1 / mean, or 0 in the dark
  float relative_shift;  // 1 − centre / mean

  /// L / mean − 1
  float relative(float luminance) const {
    return (luminance - centre) * reciprocal - relative_shift;
  }
};

/// n · D of a window from n parts, one a neighbour; see window.h.
struct Chi2 {
  static constexpr bool with_root = false;
  static float part(const WindowMean& window, float luminance, float) {
    const float d = window.relative(luminance);
    return d * d;
  }
  static float sum_to_divergence(const WindowMean&, float sum) { return sum; }
};

struct Hellinger {
  static constexpr bool with_root = true;
  static float part(const WindowMean& window, float, float root) {
    const float d = root - std::sqrt(window.mean);
    return d * d;
  }
  static float sum_to_divergence(const WindowMean& window, float sum) {
    return 0.5f * window.reciprocal * sum;
  }
};

struct KullbackLeibler {
  static constexpr bool with_root = false;
  /// φ(d) = (1 + d) ln(1 + d) − d, without a branch: with 1 + d = x = 2^e (1 + f) and
  /// 1 + f in [√½, √2), φ(d) = e ln 2 · x + 2^e φ(f) + (1 − 2^e). Near x = 1 only φ(f) is left.
  static float part(const WindowMean& window, float luminance, float) {
    const float x = luminance * window.reciprocal;
    const float d = window.relative(luminance);
    const auto bits = std::bit_cast<std::int32_t>(x);
    // e where a float keeps its exponent, so that no shift is needed.
    const std::int32_t e = (bits - 0x3f3504f3) & ~0x7fffff;
    const float power = std::bit_cast<float>(e + 0x3f800000);
    const float f = e == 0 ? d : std::bit_cast<float>(bits - e) - 1.0f;
    // φ(f)/f² interpolated at Chebyshev nodes: relative error 2.2e-6, half of it after the root.
    float p = -0.0202037778f;
    p = p * f + 0.0357609953f;
    p = p * f - 0.0505547449f;
    p = p * f + 0.0832497204f;
    p = p * f - 0.1666533782f;
    p = p * f + 0.5000004711f;
    return (float(e) * (0.69314718f * 0x1p-23f)) * x + (power * (f * f * p) + (1.0f - power));
  }
  static float sum_to_divergence(const WindowMean&, float sum) { return sum; }
};

/// (1/n) · L̄ · √D of the window around pixel x over the columns x + First … x + Last.
template <class Divergence, int Rows, int First, int Last>
inline float window_error(const WindowRows<Rows>& rows, int x) {
  constexpr int columns = Last - First + 1;
  constexpr float inverse_n = 1.0f / float(Rows * columns);
  // Written out by the compiler for each neighbour: it gives up on vectors where loops remain.
  const auto sum_over_window = [&](auto value) {
    return [&]<int... Tap>(std::integer_sequence<int, Tap...>) {
      return (value(Tap / columns, x + First + Tap % columns) + ...);
    }
    (std::make_integer_sequence<int, Rows * columns>());
  };
  WindowMean window;
  window.centre = rows.centre[x];
  const float shift = inverse_n * sum_over_window([&](int row, int column) {
                        return rows.luminance[row][column] - window.centre;
                      });
  window.mean = window.centre + shift;
  window.reciprocal = window.mean > darkest ? 1.0f / window.mean : 0.0f;
  window.relative_shift = shift * window.reciprocal;
  const float sum = sum_over_window([&](int row, int column) {
    return Divergence::part(window, rows.luminance[row][column],
                            Divergence::with_root ? rows.root[row][column] : 0.0f);
  });
  const float divergence = inverse_n * Divergence::sum_to_divergence(window, sum);
  return window.mean > darkest ? window.mean * std::sqrt(divergence) * inverse_n : 0.0f;
}

template <class Divergence, int Rows>
void row_errors(const WindowRows<Rows>& rows, int width, float* error) {
  if (width == 1) {
    error[0] = window_error<Divergence, Rows, 0, 0>(rows, 0);
    return;
  }
  error[0] = window_error<Divergence, Rows, 0, 1>(rows, 0);
#pragma omp simd
  for (int x = 1; x < width - 1; ++x) {
    error[x] = window_error<Divergence, Rows, -1, 1>(rows, x);
  }
  error[width - 1] = window_error<Divergence, Rows, -1, 0>(rows, width - 1);
}

/// `first` is the first row of the window, `centre` that of its centre; row y is in ring[y % 3].
template <class Divergence, int Rows>
void row_errors(const std::array<LuminanceRow, 3>& ring, int first, int centre, int width,
                float* error) {
  WindowRows<Rows> rows;
  for (int i = 0; i < Rows; ++i) {
    rows.luminance[i] = ring[std::size_t(first + i) % 3].luminance.data();
    rows.root[i] = ring[std::size_t(first + i) % 3].root.data();
  }
  rows.centre = ring[std::size_t(centre) % 3].luminance.data();
  row_errors<Divergence>(rows, width, error);
}

/// Rows [begin, end).
template <class Divergence>
void divergence_rows(const Film& film, int begin, int end, std::span<float> error) {
  const int width = film.width();
  const int height = film.height();
  std::array<LuminanceRow, 3> ring;
  const auto load = [&](int y) { ring[std::size_t(y) % 3].load(film, y, Divergence::with_root); };
  load(std::max(begin - 1, 0));
  load(begin);
  for (int y = begin; y < end; ++y) {
    if (y + 1 < height) {
      load(y + 1);
    }
    const int first = std::max(y - 1, 0);
    float* out = error.data() + std::size_t(y) * std::size_t(width);
    switch (std::min(y + 1, height - 1) - first + 1) {
      case 3:
        row_errors<Divergence, 3>(ring, first, y, width, out);
        break;
      case 2:
        row_errors<Divergence, 2>(ring, first, y, width, out);
        break;
      default:
        row_errors<Divergence, 1>(ring, first, y, width, out);
    }
  }
}

template <class Divergence>
void divergence_plane(const Film& film, std::span<float> error) {
  assert(error.size() == film.size());
  parallel_for(std::size_t(film.height()), grain_rows, [&](std::size_t begin, std::size_t end) {
    divergence_rows<Divergence>(film, int(begin), int(end), error);
  });
}

/// `error` is three planes: R, G, B.
void estimate_contrast(const EstimatorInput& input, std::span<float> error) {
  const Film& film = input.film;
  assert(error.size() == 3 * film.size());
  parallel_for(std::size_t(film.height()), grain_rows, [&](std::size_t begin, std::size_t end) {
    for (int c = 0; c < 3; ++c) {
      contrast_rows(film.mean(c), film.width(), film.height(), int(begin), int(end),
                    error.data() + std::size_t(c) * film.size());
    }
  });
}

// `error` is one plane each.

void estimate_kl(const EstimatorInput& input, std::span<float> error) {
  divergence_plane<KullbackLeibler>(input.film, error);
}

void estimate_chi2(const EstimatorInput& input, std::span<float> error) {
  divergence_plane<Chi2>(input.film, error);
}

void estimate_hellinger(const EstimatorInput& input, std::span<float> error) {
  divergence_plane<Hellinger>(input.film, error);
}

constexpr std::string_view tuned_by_eye = "tuned by eye against contrast in the 2021 report";

}  // namespace

constexpr Estimator contrast_estimator{
    .key = EstimatorId::contrast,
    .id = "contrast",
    .label = "Mitchell contrast",
    .unit = "contrast",
    .source = "Mitchell 1987, Generating Antialiased Images at Low Sampling Densities",
    .threshold_source = "Mitchell 1987",
    .channels = 3,
    .default_thresholds = {0.4f, 0.3f, 0.6f},
    .estimate = estimate_contrast,
    .default_policy = PolicyId::vote};

constexpr Estimator kl_estimator{.key = EstimatorId::kl,
                                 .id = "kl",
                                 .label = "√ Kullback–Leibler",
                                 .unit = "radiance",
                                 .source = rigau_2003,
                                 .threshold_source = tuned_by_eye,
                                 .channels = 1,
                                 .default_thresholds = {0.005f, 0.0f, 0.0f},
                                 .estimate = estimate_kl,
                                 .default_policy = PolicyId::vote};

constexpr Estimator chi2_estimator{.key = EstimatorId::chi2,
                                   .id = "chi2",
                                   .label = "√ χ²",
                                   .unit = "radiance",
                                   .source = rigau_2003,
                                   .threshold_source = tuned_by_eye,
                                   .channels = 1,
                                   .default_thresholds = {0.007f, 0.0f, 0.0f},
                                   .estimate = estimate_chi2,
                                   .default_policy = PolicyId::vote};

constexpr Estimator hellinger_estimator{.key = EstimatorId::hellinger,
                                        .id = "hellinger",
                                        .label = "√ Hellinger",
                                        .unit = "radiance",
                                        .source = rigau_2003,
                                        .threshold_source = tuned_by_eye,
                                        .channels = 1,
                                        .default_thresholds = {0.003f, 0.0f, 0.0f},
                                        .estimate = estimate_hellinger,
                                        .default_policy = PolicyId::vote};

}  // namespace quartet
