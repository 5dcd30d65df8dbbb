#pragma once

#include <string>

#include "renderer/measure/metrics.h"
#include "ui/paper/figure.h"

namespace quartet {

/// Where a picture is off: the error of each pixel in colours with their bar, and the metric's
/// value. The scale ends at what 99.9 % of the pixels stay below, for one firefly would leave the
/// rest dark; it is logarithmic, over four decades, where most errors are far below that. Pixels
/// that are not finite are left out of it, gray, and counted.
Figure error_figure(const RadianceImage& test, const RadianceImage& reference, const Metric& metric,
                    std::string title, std::string footer);

}  // namespace quartet
