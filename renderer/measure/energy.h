#pragma once

#include <string>

#include "renderer/base/image.h"

namespace quartet {

/// Mean of the Rec. 709 luminance of a picture of linear radiance; it must not be empty.
double mean_luminance(const RadianceImage& image);

/// The signed energy error: mean luminance over that of the reference, less 1. It stands beside
/// every error, because most metrics prefer a picture that has lost its brightest samples. A sample
/// mean has none but by chance; what is clamped, or stops where samples happen to agree, is too
/// dark. NaN if the reference is black.
double energy_error(const RadianceImage& test, const RadianceImage& reference);
/// The same of mean luminances.
double energy_error(double test, double reference);

/// "+1.25 %"; a dash if it is NaN.
std::string energy_text(double energy);

}  // namespace quartet
