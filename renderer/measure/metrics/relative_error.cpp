#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

double relative_squared(double x, double r) {
  return (x - r) * (x - r) / (r * r + 0.01);
}

double relative_difference(double x, double r) {
  return (x - r) / std::sqrt(r * r + 0.01);
}

double relmse_trimmed(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  const std::span<const float> x = channels_of(test);
  const std::span<const float> r = channels_of(reference);
  std::vector<double> errors(x.size());
  for_metric_blocks(test.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
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

constexpr std::string_view relative_squared_error = "(x − r)²/(r² + 0.01)";

}  // namespace

constexpr Metric relmse_metric{.key = MetricId::relmse,
                               .id = "relmse",
                               .label = "relMSE",
                               .unit = "",
                               .definition = "mean of (x − r)²/(r² + 0.01)",
                               .scale = MetricScale::squared_error,
                               .compute = mean_over_values<relative_squared>,
                               .map = map_of<relative_squared>,
                               .map_quantity = relative_squared_error,
                               .errors = errors_of<relative_difference>};

constexpr Metric relmse_trimmed_metric{
    .key = MetricId::relmse_trimmed,
    .id = "relmse_trimmed",
    .label = "relMSE, trimmed",
    .unit = "",
    .definition = "mean of (x − r)²/(r² + 0.01) without the largest 0.1 %; blind to lost caustics",
    .scale = MetricScale::squared_error,
    .compute = relmse_trimmed,
    .map = map_of<relative_squared>,
    .map_quantity = relative_squared_error};

}  // namespace quartet
