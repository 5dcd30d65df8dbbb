#pragma once

#include <string>

#include "renderer/measure/metrics.h"
#include "ui/figure.h"

namespace quartet {

/// Where a picture is off: the error of each pixel in colours with their bar, from 0 to what 99.9 %
/// of the pixels stay below (one firefly would leave the rest black), and the metric's value.
Figure error_figure(const RadianceImage& test, const RadianceImage& reference, const Metric& metric,
                    std::string title, std::string footer);

}  // namespace quartet
