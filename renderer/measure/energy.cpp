#include "renderer/measure/energy.h"

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
  const double right = mean_luminance(reference);
  return right > 0.0 ? mean_luminance(test) / right - 1.0
                     : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace quartet
