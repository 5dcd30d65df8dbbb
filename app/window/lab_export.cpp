#include "app/window/lab_export.h"

#include <fmt/format.h>

#include "app/options/lane_option.h"
#include "app/options/view_options.h"
#include "app/records/lab_files.h"
#include "app/terminal/home_folder.h"
#include "app/terminal/shell_words.h"
#include "renderer/base/cancel.h"
#include "renderer/files/exr.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr std::string_view reference_file = "reference.exr";

std::string camera_text(const Camera& camera) {
  std::string text;
  for (const glm::vec3 v : {camera.origin, camera.right, camera.up, camera.forward}) {
    for (int i = 0; i < 3; ++i) {
      text += fmt::format("{}{}", text.empty() ? "" : ",", v[i]);
    }
  }
  return text;
}

/// Whether there was a file that holds just this reference.
bool stage_reference(StagedFiles& files, const Reference* reference, const std::stop_token& stop) {
  if (reference == nullptr || reference->path.empty()) {
    return false;
  }
  if (!reference->ours()) {
    // As it was taken, whatever format and layer it came from.
    ExrImage exr(reference->image.width(), reference->image.height());
    exr.add_radiance(reference->image);
    write_exr(files.stage(reference_file), exr);
    return true;
  }
  try {
    const ExrImage exr = read_exr(reference->path, stop);
    if (radiance_of(exr, reference->path) != reference->image) {
      return false;  // it has more samples by now, or is another
    }
    write_exr(files.stage(reference_file), exr);
    return true;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::string reproducing_command(const Snapshot& snapshot, const ViewSettings& view,
                                const std::string& scene, const std::string& folder,
                                const std::filesystem::path& reference) {
  const RenderSettings& settings = snapshot.settings;
  std::string command = "quartet figure " + shell_word(scene);
  command += fmt::format(" --passes {} --size {}x{} --seed {}", snapshot.pass, settings.width,
                         settings.height, settings.seed);
  // What draws its samples has no paths and no camera, and its command no options for them.
  const Scene& traced = snapshot.scene->scene();
  if (synthetic_of(traced) == nullptr) {
    command += fmt::format(" --integrator {} --sampler {}", integrator(settings.integrator).id,
                           sampler_row(settings.sampler).id);
    if (settings.max_depth != traced.max_depth) {
      command += fmt::format(" --max-depth {}", settings.max_depth);
    }
    if (!(settings.camera == traced.camera)) {
      command += " --camera=" + camera_text(settings.camera);
    }
  }
  for (const LaneSnapshot& lane : snapshot.lanes) {
    command += " --lane " + lane_text(lane.settings);
  }
  if (!reference.empty()) {
    command += " --reference " + shell_word(reference.string());
  }
  const ViewSettings plain;
  if (view.heat != plain.heat) {
    command += " --heat " + heat_id(view.heat);
  }
  if (view.tone_map != plain.tone_map) {
    command += fmt::format(" --tone-map {}", tone_map_row(view.tone_map).id);
  }
  if (view.exposure != plain.exposure) {
    command += fmt::format(" --exposure={}", view.exposure);
  }
  return command + " --out " + shell_word(folder);
}

LabExport export_lab(const Snapshot& snapshot, const ViewSettings& view, const ExportForm& form,
                     const std::string& scene, const Reference* reference,
                     const std::stop_token& stop) {
  Snapshot chosen = snapshot;
  if (form.lane >= 0 && std::size_t(form.lane) < snapshot.lanes.size()) {
    chosen.lanes = {snapshot.lanes[std::size_t(form.lane)]};
  }
  const std::filesystem::path folder = form.folder;
  StagedFiles files(folder);
  const bool named = stage_reference(files, reference, stop);
  const std::string command = reproducing_command(
      chosen, view, scene, form.folder, named ? folder / reference_file : std::filesystem::path());
  LabExport done{std::filesystem::absolute(folder).lexically_normal(), ""};
  if (chosen.reference && !named) {
    done.lacks = "command.txt needs --reference: the reference that was used is in no file";
  }
  write_lab_files(files, chosen, view, command, std::nullopt, reference, stop);
  files.write("command.txt", command + (done.lacks.empty() ? "\n" : "\n# " + done.lacks + "\n"));
  check_cancelled(stop);
  files.commit();
  return done;
}

ExportStatus export_status(const ExportRequest& request, const std::stop_token& stop) {
  ExportStatus status;
  try {
    ExportForm form = request.form;
    form.folder = typed_path(form.folder).string();
    status.done = export_lab(*request.snapshot, request.view, form, request.scene,
                             request.reference.get(), stop);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    status.error = error.what();
  }
  return status;
}

}  // namespace quartet
