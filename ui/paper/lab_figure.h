#pragma once

#include <string>

#include "renderer/session/snapshot.h"
#include "renderer/view/views.h"
#include "ui/paper/figure.h"

namespace quartet {

/// "threshold 0.005" or "thresholds 0.4, 0.3, 0.6"; "no threshold" for uniform.
std::string threshold_text(const LaneSettings& settings);

/// The lanes' pictures side by side, each labelled with criterion, threshold, mean and maximum
/// samples per pixel and as-if-alone seconds: figure 2 of the 2021 report.
Figure image_figure(const Snapshot& snapshot, const ViewSettings& view, std::string title,
                    std::string footer);

/// The same for samples per pixel: figure 1 of the report.
Figure heat_figure(const Snapshot& snapshot, const ViewSettings& view, std::string title,
                   std::string footer);

/// Whether a figure of so many panels of this size can be painted, whatever its texts say and with
/// a colour bar for each panel if they have one. Throws std::invalid_argument that begins with
/// `option`, the name of the one that decides the size, and says the limit.
void check_figure_size(const std::string& option, int width, int height, std::size_t panels,
                       bool panel_bars);

}  // namespace quartet
