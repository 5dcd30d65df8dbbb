#pragma once

#include <span>
#include <string>

#include "renderer/adaptive/lane.h"
#include "renderer/image/tone_map.h"
#include "renderer/image/views.h"
#include "ui/figure.h"

namespace quartet {

/// How lanes are shown; changes nothing that is computed.
struct ViewSettings {
  float exposure = 0.0f;  ///< stops
  ToneMap tone_map = ToneMap::clamp;
  HeatRange heat = HeatRange::linked;
};

/// "threshold 0.005" or "thresholds 0.4, 0.3, 0.6"; "no threshold" for uniform.
std::string threshold_text(const SamplingPolicy& policy);

/// The lanes' pictures side by side, each labelled with criterion, threshold, mean and maximum
/// samples per pixel and as-if-alone seconds: figure 2 of the 2021 report.
Figure image_figure(std::span<const Lane> lanes, const ViewSettings& view, std::string title,
                    std::string footer);

/// The same for samples per pixel: figure 1 of the report.
Figure heat_figure(std::span<const Lane> lanes, const ViewSettings& view, std::string title,
                   std::string footer);

}  // namespace quartet
