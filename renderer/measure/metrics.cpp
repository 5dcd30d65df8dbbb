#include "renderer/measure/metrics.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "renderer/base/table.h"
#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

const Metric* row_of_metric(MetricId key) {
  switch (key) {
    case MetricId::mse:
      return &mse_metric;
    case MetricId::rmse:
      return &rmse_metric;
    case MetricId::relmse:
      return &relmse_metric;
    case MetricId::relmse_trimmed:
      return &relmse_trimmed_metric;
    case MetricId::relmse_regions:
      return &relmse_regions_metric;
    case MetricId::mape:
      return &mape_metric;
    case MetricId::smape:
      return &smape_metric;
    case MetricId::psnr:
      return &psnr_metric;
    case MetricId::flip:
      return &flip_metric;
  }
  return nullptr;
}

}  // namespace

std::span<const Metric> metrics() {
  static const std::vector<Metric> table = table_of(row_of_metric);
  return table;
}

const Metric& metric(MetricId key) {
  return row_of(metrics(), key);
}

const Metric& find_metric(std::string_view id) {
  return find_row(metrics(), id, "metric");
}

double times_better(const Metric& row, double value, double than) {
  return row.scale == MetricScale::decibels ? std::pow(10.0, (value - than) / 10.0) : than / value;
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
