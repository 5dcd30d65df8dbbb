#include <algorithm>
#include <cmath>

#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

/// sRGB of a value clamped to [0, 1], not rounded to 8 bits; NaN must not come here.
float display_value(float linear) {
  const float x = std::clamp(linear, 0.0f, 1.0f);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

double display_squared(double x, double r) {
  return squared_difference(display_value(float(x)), display_value(float(r)));
}

double psnr(const RadianceImage& test, const RadianceImage& reference) {
  return -10.0 * std::log10(mean_over_values<display_squared>(test, reference));
}

}  // namespace

constexpr Metric psnr_metric{.key = MetricId::psnr,
                             .id = "psnr",
                             .label = "PSNR",
                             .unit = "dB",
                             .definition = "10 log10(1/MSE) of sRGB values, radiance cut to [0, 1]",
                             .scale = MetricScale::decibels,
                             .higher_is_better = true,
                             .compute = psnr,
                             .map = map_of<display_squared>,
                             .map_quantity = "squared error of sRGB values"};

}  // namespace quartet
