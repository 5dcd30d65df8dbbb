#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/adaptive/estimators/window_kernel.h"
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
  const auto write = [=](int x, int left, int right) {
    low[x] = std::min(std::min(row[left], row[x]), row[right]);
    high[x] = std::max(std::max(row[left], row[x]), row[right]);
  };
  write(0, 0, std::min(1, width - 1));
#pragma omp simd
  for (int x = 1; x < width - 1; ++x) {
    low[x] = std::min(std::min(row[x - 1], row[x]), row[x + 1]);
    high[x] = std::max(std::max(row[x - 1], row[x]), row[x + 1]);
  }
  write(width - 1, std::max(width - 2, 0), width - 1);
}

/// Of each channel: the lowest and then the highest.
void reduce_to_extremes(const MeanRow& means, int width, float* reduced) {
  for (const float* channel : means) {
    row_extremes(channel, width, reduced, reduced + width);
    reduced += 2 * std::ptrdiff_t(width);
  }
}

void contrast_errors(const WindowRows& rows, int width, const ErrorRow& error) {
  for (std::size_t c = 0; c < error.size(); ++c) {
    const std::size_t low = 2 * c * std::size_t(width);
    const std::size_t high = low + std::size_t(width);
    const float* above = rows.above ? rows.above : rows.here;
    const float* below = rows.below ? rows.below : rows.here;
    const float* low_above = above + low;
    const float* low_here = rows.here + low;
    const float* low_below = below + low;
    const float* high_above = above + high;
    const float* high_here = rows.here + high;
    const float* high_below = below + high;
    float* out = error[c];
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

/// Rec. 709 luminances.
void reduce_to_luminance(const MeanRow& means, int width, float* reduced) {
  const float* r = means[0];
  const float* g = means[1];
  const float* b = means[2];
#pragma omp simd
  for (int x = 0; x < width; ++x) {
    reduced[x] = std::min(brightest, quartet::luminance(r[x], g[x], b[x]));
  }
}

/// And then their roots.
void reduce_to_roots(const MeanRow& means, int width, float* reduced) {
  reduce_to_luminance(means, width, reduced);
#pragma omp simd
  for (int x = 0; x < width; ++x) {
    reduced[width + x] = std::sqrt(reduced[x]);
  }
}

/// The rows of luminances of a window, 1 to 3, and the one with its centre.
template <int Rows>
struct LuminanceRows {
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
inline float window_error(const LuminanceRows<Rows>& rows, int x) {
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
void row_errors(const LuminanceRows<Rows>& rows, int width, float* error) {
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

/// `first` is the topmost row of the window.
template <class Divergence, int Rows>
void row_errors(const std::array<const float*, 3>& reduced, std::size_t first, const float* centre,
                int width, float* error) {
  LuminanceRows<Rows> rows;
  for (std::size_t i = 0; i < Rows; ++i) {
    rows.luminance[i] = reduced[first + i];
    rows.root[i] = Divergence::with_root ? reduced[first + i] + width : nullptr;
  }
  rows.centre = centre;
  row_errors<Divergence>(rows, width, error);
}

template <class Divergence>
void divergence_errors(const WindowRows& rows, int width, const ErrorRow& error) {
  const std::array reduced{rows.above, rows.here, rows.below};
  if (rows.above && rows.below) {
    row_errors<Divergence, 3>(reduced, 0, rows.here, width, error[0]);
  } else if (rows.above) {
    row_errors<Divergence, 2>(reduced, 0, rows.here, width, error[0]);
  } else if (rows.below) {
    row_errors<Divergence, 2>(reduced, 1, rows.here, width, error[0]);
  } else {
    row_errors<Divergence, 1>(reduced, 1, rows.here, width, error[0]);
  }
}

constexpr WindowKernel contrast_kernel{6, reduce_to_extremes, contrast_errors};
constexpr WindowKernel kl_kernel{1, reduce_to_luminance, divergence_errors<KullbackLeibler>};
constexpr WindowKernel chi2_kernel{1, reduce_to_luminance, divergence_errors<Chi2>};
constexpr WindowKernel hellinger_kernel{2, reduce_to_roots, divergence_errors<Hellinger>};

/// Rows [begin, end) of a picture.
void film_errors(const WindowKernel& kernel, const Film& film, int begin, int end,
                 std::span<float> error) {
  const int width = film.width();
  // The last three rows, so that each is reduced once.
  const std::size_t row_floats = std::size_t(kernel.values) * std::size_t(width);
  std::vector<float> ring(3 * row_floats);
  const auto reduced = [&](int y) -> float* {
    return y < 0 || y >= film.height() ? nullptr : ring.data() + std::size_t(y % 3) * row_floats;
  };
  const auto first = [&](int y) { return std::size_t(y) * std::size_t(width); };
  const auto load = [&](int y) {
    kernel.reduce({film.mean(0).data() + first(y), film.mean(1).data() + first(y),
                   film.mean(2).data() + first(y)},
                  width, reduced(y));
  };
  load(std::max(begin - 1, 0));
  load(begin);
  for (int y = begin; y < end; ++y) {
    if (y + 1 < film.height()) {
      load(y + 1);
    }
    ErrorRow out{};
    for (std::size_t c = 0; c * film.size() < error.size(); ++c) {
      out[c] = error.data() + c * film.size() + first(y);
    }
    kernel.errors({reduced(y - 1), reduced(y), reduced(y + 1)}, width, out);
  }
}

/// The estimate of a kernel, over a whole film.
template <const WindowKernel& kernel>
void estimate_windows(const EstimatorInput& input, std::span<float> error) {
  parallel_for(std::size_t(input.film.height()), grain_rows,
               [&](std::size_t begin, std::size_t end) {
                 film_errors(kernel, input.film, int(begin), int(end), error);
               });
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
    .estimate = estimate_windows<contrast_kernel>,
    .window = &contrast_kernel,
    .default_policy = PolicyId::vote};

constexpr Estimator kl_estimator{.key = EstimatorId::kl,
                                 .id = "kl",
                                 .label = "√ Kullback–Leibler",
                                 .unit = "radiance",
                                 .source = rigau_2003,
                                 .threshold_source = tuned_by_eye,
                                 .channels = 1,
                                 .default_thresholds = {0.005f, 0.0f, 0.0f},
                                 .estimate = estimate_windows<kl_kernel>,
                                 .window = &kl_kernel,
                                 .default_policy = PolicyId::vote};

constexpr Estimator chi2_estimator{.key = EstimatorId::chi2,
                                   .id = "chi2",
                                   .label = "√ χ²",
                                   .unit = "radiance",
                                   .source = rigau_2003,
                                   .threshold_source = tuned_by_eye,
                                   .channels = 1,
                                   .default_thresholds = {0.007f, 0.0f, 0.0f},
                                   .estimate = estimate_windows<chi2_kernel>,
                                   .window = &chi2_kernel,
                                   .default_policy = PolicyId::vote};

constexpr Estimator hellinger_estimator{.key = EstimatorId::hellinger,
                                        .id = "hellinger",
                                        .label = "√ Hellinger",
                                        .unit = "radiance",
                                        .source = rigau_2003,
                                        .threshold_source = tuned_by_eye,
                                        .channels = 1,
                                        .default_thresholds = {0.003f, 0.0f, 0.0f},
                                        .estimate = estimate_windows<hellinger_kernel>,
                                        .window = &hellinger_kernel,
                                        .default_policy = PolicyId::vote};

}  // namespace quartet
