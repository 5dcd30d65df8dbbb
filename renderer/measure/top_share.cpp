#include "renderer/measure/top_share.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "renderer/measure/left_out.h"

namespace quartet {

double top_share(std::vector<float> errors) {
  const std::size_t count = (errors.size() + 999) / 1000;
  const auto rest = errors.begin() + std::ptrdiff_t(count);
  if (rest != errors.end()) {
    std::nth_element(errors.begin(), rest, errors.end(), std::greater<>());
  }
  const double top = std::accumulate(errors.begin(), rest, 0.0);
  const double all = std::accumulate(rest, errors.end(), top);
  return all > 0.0 ? top / all : std::numeric_limits<double>::quiet_NaN();
}

double relmse_top_share(const RadianceImage& test, const RadianceImage& reference) {
  const ScalarImage map = map_over_finite(metric(MetricId::relmse), test, reference);
  const LeftOut left_out = left_out_of(test, reference);
  std::vector<float> errors;
  errors.reserve(map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (left_out.is_left_out[i] == 0) {
      errors.push_back(map.pixels()[i]);
    }
  }
  return top_share(std::move(errors));
}

std::string top_share_text(double share) {
  return std::isnan(share) ? "–" : fmt::format("{:.0f} %", 100.0 * share);
}

}  // namespace quartet
