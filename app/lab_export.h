#pragma once

#include <filesystem>
#include <string>

#include "renderer/adaptive/snapshot.h"
#include "renderer/image/views.h"
#include "ui/lab_state.h"

namespace quartet {

/// The command that makes the same files from nothing. `scene` as the user named it.
std::string reproducing_command(const Snapshot& snapshot, const ViewSettings& view,
                                const std::string& scene, const std::string& folder);

/// Saves what `quartet figure` would, of all lanes or of one, and the command line that does so as
/// command.txt. Returns the folder, in full. Throws std::runtime_error.
std::filesystem::path export_lab(const Snapshot& snapshot, const ViewSettings& view,
                                 const ExportForm& form, const std::string& scene);

}  // namespace quartet
