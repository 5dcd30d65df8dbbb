#include <cmath>

#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

double difference(double x, double r) {
  return x - r;
}

double rmse(const RadianceImage& test, const RadianceImage& reference) {
  return std::sqrt(mean_over_values<squared_difference>(test, reference));
}

constexpr std::string_view squared_error = "squared error (radiance²)";

}  // namespace

constexpr Metric mse_metric{.key = MetricId::mse,
                            .id = "mse",
                            .label = "MSE",
                            .unit = "radiance²",
                            .definition = "mean of (x − r)²",
                            .scale = MetricScale::squared_error,
                            .floor_by_halves = true,
                            .compute = mean_over_values<squared_difference>,
                            .map = map_of<squared_difference>,
                            .map_quantity = squared_error,
                            .errors = errors_of<difference>};

constexpr Metric rmse_metric{.key = MetricId::rmse,
                             .id = "rmse",
                             .label = "RMSE",
                             .unit = "radiance",
                             .definition = "√ of the mean of (x − r)²",
                             .scale = MetricScale::error,
                             .floor_by_halves = true,
                             .compute = rmse,
                             .map = map_of<squared_difference>,
                             .map_quantity = squared_error};

}  // namespace quartet
