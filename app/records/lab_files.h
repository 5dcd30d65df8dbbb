#pragma once

#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "renderer/files/staged_files.h"
#include "renderer/view/views.h"

namespace quartet {

/// The names of all that write_lab_files writes.
std::vector<std::string> lab_file_names(std::span<const LaneSettings> lane_settings);

/// Everything that is saved of lanes at a pass, by the command line and by the window: the two
/// figures (images and heatmaps, PNG and PDF), each lane's EXR, PNG and heatmap, panels.csv and
/// panels.json. EXR and JSON hold files.run(). `reference` says where that of the snapshot comes
/// from, if that is known. Throws Cancelled between two files once `stop` is asked for.
void write_lab_files(StagedFiles& files, const Snapshot& snapshot, const ViewSettings& view,
                     const std::string& command_line, const std::optional<RunCost>& cost,
                     const Reference* reference = nullptr, const std::stop_token& stop = {});

}  // namespace quartet
