#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/image.h"

namespace quartet {

/// The share of all errors that sits in the largest thousandth of them, rounded up to whole ones;
/// none is negative. NaN where there is no error at all.
double top_share(std::vector<float> errors);

/// top_share() of what the pixels add to relMSE: how much of that number a few fireflies are. Near
/// 1 it says next to nothing of the other pixels. Pixels that are not finite in one of the pictures
/// are left out, as in compute_over_finite(), with its exceptions.
double relmse_top_share(const RadianceImage& test, const RadianceImage& reference);

/// What it is called in files, where it stands behind relMSE.
inline constexpr std::string_view top_share_id = "relmse_top_thousandth";

/// "83 %"; a dash if it is NaN.
std::string top_share_text(double share);

}  // namespace quartet
