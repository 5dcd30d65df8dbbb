#pragma once

#include <filesystem>
#include <string>

#include "renderer/adaptive/snapshot.h"
#include "renderer/image/views.h"
#include "renderer/measure/reference.h"
#include "ui/lab_state.h"

namespace quartet {

/// The command that makes the same files from nothing. `scene` as the user named it; `reference` is
/// a file, or empty.
std::string reproducing_command(const Snapshot& snapshot, const ViewSettings& view,
                                const std::string& scene, const std::string& folder,
                                const std::filesystem::path& reference);

/// What has become of an export.
struct LabExport {
  std::filesystem::path folder;  ///< in full
  std::string lacks;             ///< what the command line cannot do; empty if all is well
};

/// Saves what `quartet figure` would, of all lanes or of one, and the command line that does so as
/// command.txt. `reference` is that of the snapshot, null if none is known. A copy of its file goes
/// along: the file itself may get more samples. Throws std::runtime_error.
LabExport export_lab(const Snapshot& snapshot, const ViewSettings& view, const ExportForm& form,
                     const std::string& scene, const Reference* reference);

}  // namespace quartet
