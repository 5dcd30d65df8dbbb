#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include "renderer/measure/reference/reference.h"
#include "renderer/session/snapshot.h"
#include "renderer/view/views.h"
#include "ui/window/lab_state.h"

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
/// along: the file itself may get more samples. Throws std::runtime_error, or Cancelled once `stop`
/// is asked for: then nothing was written.
LabExport export_lab(const Snapshot& snapshot, const ViewSettings& view, const ExportForm& form,
                     const std::string& scene, const Reference* reference,
                     const std::stop_token& stop = {});

/// What to save, as export_lab takes it. The folder is one as it is typed: "~/figs".
struct ExportRequest {
  std::shared_ptr<const Snapshot> snapshot;
  ViewSettings view;
  ExportForm form;
  std::string scene;
  std::shared_ptr<const Reference> reference;
};

struct ExportStatus {
  LabExport done;
  std::string error;  ///< one line; empty if all is well
};

/// Exports, and says how it went. Throws Cancelled once `stop` is asked for, and nothing else.
ExportStatus export_status(const ExportRequest& request, const std::stop_token& stop);

}  // namespace quartet
