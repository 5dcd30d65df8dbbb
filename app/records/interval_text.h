#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "renderer/base/interval.h"

namespace quartet {

/// A share: "−4.00 % (−4.20 to −3.80)"; without ends where they are not known, a dash if it is NaN.
inline std::string percent_text(const Interval& share) {
  if (std::isnan(share.mean)) {
    return "–";
  }
  const std::string mean = fmt::format("{:+.2f} %", 100.0 * share.mean);
  return std::isfinite(share.high - share.low)
             ? fmt::format("{} ({:+.2f} to {:+.2f})", mean, 100.0 * share.low, 100.0 * share.high)
             : mean;
}

/// A ratio: "0.640 (0.510 to 0.790)"; the same.
inline std::string ratio_text(const Interval& ratio) {
  if (std::isnan(ratio.mean)) {
    return "–";
  }
  return std::isfinite(ratio.high - ratio.low)
             ? fmt::format("{:.3f} ({:.3f} to {:.3f})", ratio.mean, ratio.low, ratio.high)
             : fmt::format("{:.3f}", ratio.mean);
}

}  // namespace quartet
