#include "renderer/measure/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "renderer/base/parallel.h"
#include "renderer/base/table.h"
#include "renderer/measure/flip.h"

namespace quartet {

namespace {

// What one channel of one pixel contributes. In double, where the square of any float is finite.

double squared(double x, double r) {
  return (x - r) * (x - r);
}

double relative_squared(double x, double r) {
  return (x - r) * (x - r) / (r * r + 0.01);
}

double absolute_percentage(double x, double r) {
  return std::abs(x - r) / (std::abs(r) + 0.01);
}

double symmetric_percentage(double x, double r) {
  return 2.0 * std::abs(x - r) / (std::abs(x) + std::abs(r) + 0.01);
}

/// sRGB of a value clamped to [0, 1], not rounded to 8 bits; NaN must not come here.
float display_value(float linear) {
  const float x = std::clamp(linear, 0.0f, 1.0f);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

double display_squared(double x, double r) {
  return squared(display_value(float(x)), display_value(float(r)));
}

using Term = double(double, double);

constexpr std::size_t kBlock = 4096;  // pixels; sums are made by block, whichever thread has it

/// The channels of a picture's pixels, one after the other.
std::span<const float> channels_of(const RadianceImage& image) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {&image.pixels().front().x, 3 * image.size()};
}

bool all_finite(std::span<const float> values) {
  int bad = 0;
  for (const float value : values) {
    bad |= std::abs(value) <= std::numeric_limits<float>::max() ? 0 : 1;  // of NaN, too
  }
  return bad == 0;
}

/// Calls body(block, begin, end) for every block of pixels.
template <class Body>
void for_blocks(std::size_t pixels, const Body& body) {
  parallel_for((pixels + kBlock - 1) / kBlock, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block) {
      body(block, block * kBlock, std::min(pixels, (block + 1) * kBlock));
    }
  });
}

void require_comparable(const RadianceImage& test, const RadianceImage& reference) {
  require_same_size(test, reference);
  require_finite(test, "the test picture");
  require_finite(reference, "the reference");
}

template <Term term>
double mean_over_values(const RadianceImage& test, const RadianceImage& reference) {
  require_same_size(test, reference);
  const std::span<const float> x = channels_of(test);
  const std::span<const float> r = channels_of(reference);
  std::vector<double> sums((test.size() + kBlock - 1) / kBlock);
  std::vector<char> finite(sums.size());
  for_blocks(test.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      sum += term(double(x[i]), double(r[i]));
    }
    sums[block] = sum;
    finite[block] = all_finite(x.subspan(3 * begin, 3 * (end - begin))) &&
                    all_finite(r.subspan(3 * begin, 3 * (end - begin)));
  });
  if (std::ranges::find(finite, 0) != finite.end()) {
    require_finite(test, "the test picture");
    require_finite(reference, "the reference");
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0) / double(x.size());
}

template <Term term>
ScalarImage map_of(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  ScalarImage map(test.width(), test.height());
  for_blocks(test.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3 x = test.pixels()[i];
      const glm::vec3 r = reference.pixels()[i];
      map.pixels()[i] = float((term(x.r, r.r) + term(x.g, r.g) + term(x.b, r.b)) / 3.0);
    }
  });
  return map;
}

double rmse(const RadianceImage& test, const RadianceImage& reference) {
  return std::sqrt(mean_over_values<squared>(test, reference));
}

double psnr(const RadianceImage& test, const RadianceImage& reference) {
  return -10.0 * std::log10(mean_over_values<display_squared>(test, reference));
}

double relmse_trimmed(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  const std::span<const float> x = channels_of(test);
  const std::span<const float> r = channels_of(reference);
  std::vector<double> errors(x.size());
  for_blocks(test.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      errors[i] = relative_squared(x[i], r[i]);
    }
  });
  const auto kept = errors.end() - std::ptrdiff_t(errors.size() / 1000);
  if (kept != errors.end()) {
    std::nth_element(errors.begin(), kept, errors.end());
  }
  return std::accumulate(errors.begin(), kept, 0.0) / double(kept - errors.begin());
}

double checked_flip(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  return flip(test, reference);
}

ScalarImage checked_flip_map(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  return flip_map(test, reference);
}

constexpr std::array kMetrics{
    Metric{MetricId::mse, "mse", "MSE", "radiance²", "mean of (x − r)²", false, true,
           mean_over_values<squared>, map_of<squared>, "squared error (radiance²)"},
    Metric{MetricId::rmse, "rmse", "RMSE", "radiance", "√ of the mean of (x − r)²", false, false,
           rmse, map_of<squared>, "squared error (radiance²)"},
    Metric{MetricId::relmse, "relmse", "relMSE", "", "mean of (x − r)²/(r² + 0.01)", false, true,
           mean_over_values<relative_squared>, map_of<relative_squared>, "(x − r)²/(r² + 0.01)"},
    Metric{MetricId::relmse_trimmed, "relmse_trimmed", "relMSE, trimmed", "",
           "mean of (x − r)²/(r² + 0.01) without the largest 0.1 %; blind to lost caustics", false,
           true, relmse_trimmed, map_of<relative_squared>, "(x − r)²/(r² + 0.01)"},
    Metric{MetricId::mape, "mape", "MAPE", "", "mean of |x − r|/(|r| + 0.01)", false, false,
           mean_over_values<absolute_percentage>, map_of<absolute_percentage>,
           "|x − r|/(|r| + 0.01)"},
    Metric{MetricId::smape, "smape", "SMAPE", "", "mean of 2 |x − r|/(|x| + |r| + 0.01)", false,
           false, mean_over_values<symmetric_percentage>, map_of<symmetric_percentage>,
           "2 |x − r|/(|x| + |r| + 0.01)"},
    Metric{MetricId::psnr, "psnr", "PSNR", "dB",
           "10 log10(1/MSE) of sRGB values, radiance cut to [0, 1]", true, false, psnr,
           map_of<display_squared>, "squared error of sRGB values"},
    Metric{MetricId::flip, "flip", "FLIP", "",
           "mean of LDR-FLIP (Andersson et al. 2020), 67 pixels a degree, radiance cut to [0, 1]",
           false, false, checked_flip, checked_flip_map, "LDR-FLIP (0 same, 1 most different)"},
};

}  // namespace

std::span<const Metric> metrics() {
  return kMetrics;
}

const Metric& metric(MetricId key) {
  return row_of(metrics(), key);
}

const Metric& find_metric(std::string_view id) {
  return find_row(metrics(), id, "metric");
}

double efficiency(double mse, double seconds) {
  const double cost = mse * seconds;
  return cost > 0.0 ? 1.0 / cost : std::numeric_limits<double>::infinity();
}

void require_same_size(const RadianceImage& test, const RadianceImage& reference) {
  if (test.width() != reference.width() || test.height() != reference.height()) {
    throw std::invalid_argument(fmt::format(
        "the test picture has {}x{} pixels and the reference {}x{}; the same size would be right",
        test.width(), test.height(), reference.width(), reference.height()));
  }
  if (test.empty()) {
    throw std::invalid_argument("both pictures are empty; one pixel at least would be right");
  }
}

void require_finite(const RadianceImage& image, std::string_view what) {
  if (image.empty() || all_finite(channels_of(image))) {
    return;
  }
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const glm::vec3 c = image.at(x, y);
      if (!all_finite({&c.x, 3})) {
        throw std::invalid_argument(fmt::format(
            "{} holds ({}, {}, {}) at pixel ({}, {}) from the top left; finite numbers would be "
            "right",
            what, c.r, c.g, c.b, x, y));
      }
    }
  }
}

}  // namespace quartet
