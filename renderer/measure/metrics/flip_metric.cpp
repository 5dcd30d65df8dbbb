#include "renderer/measure/flip.h"
#include "renderer/measure/metrics/metric_rows.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

double checked_flip(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  return flip(test, reference);
}

ScalarImage checked_flip_map(const RadianceImage& test, const RadianceImage& reference) {
  require_comparable(test, reference);
  return flip_map(test, reference);
}

}  // namespace

constexpr Metric flip_metric{.key = MetricId::flip,
                             .id = "flip",
                             .label = "FLIP",
                             .unit = "",
                             .definition =
                                 "mean of LDR-FLIP (Andersson et al. 2020), 67 pixels a "
                                 "degree, radiance cut to [0, 1]",
                             .scale = MetricScale::error,
                             .looks_around = true,
                             .compute = checked_flip,
                             .map = checked_flip_map,
                             .map_quantity = "LDR-FLIP (0 same, 1 most different)"};

}  // namespace quartet
