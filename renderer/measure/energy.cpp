#include "renderer/measure/energy.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace quartet {

double mean_luminance(const RadianceImage& image) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels()) {
    sum += double(luminance(pixel));
  }
  return sum / double(image.size());
}

double energy_error(const RadianceImage& test, const RadianceImage& reference) {
  return energy_error(mean_luminance(test), mean_luminance(reference));
}

double energy_error(double test, double reference) {
  return reference > 0.0 ? test / reference - 1.0 : std::numeric_limits<double>::quiet_NaN();
}

std::string energy_text(double energy) {
  return std::isnan(energy) ? "–" : fmt::format("{:+.2f} %", 100.0 * energy);
}

}  // namespace quartet
