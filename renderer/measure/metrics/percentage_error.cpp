#include <cmath>

#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

double absolute_percentage(double x, double r) {
  return std::abs(x - r) / (std::abs(r) + 0.01);
}

double symmetric_percentage(double x, double r) {
  return 2.0 * std::abs(x - r) / (std::abs(x) + std::abs(r) + 0.01);
}

}  // namespace

constexpr Metric mape_metric{.key = MetricId::mape,
                             .id = "mape",
                             .label = "MAPE",
                             .unit = "",
                             .definition = "mean of |x − r|/(|r| + 0.01)",
                             .scale = MetricScale::error,
                             .compute = mean_over_values<absolute_percentage>,
                             .map = map_of<absolute_percentage>,
                             .map_quantity = "|x − r|/(|r| + 0.01)"};

constexpr Metric smape_metric{.key = MetricId::smape,
                              .id = "smape",
                              .label = "SMAPE",
                              .unit = "",
                              .definition = "mean of 2 |x − r|/(|x| + |r| + 0.01)",
                              .scale = MetricScale::error,
                              .compute = mean_over_values<symmetric_percentage>,
                              .map = map_of<symmetric_percentage>,
                              .map_quantity = "2 |x − r|/(|x| + |r| + 0.01)"};

}  // namespace quartet
