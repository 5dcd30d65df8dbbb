#include "app/lab_export.h"

#include <fmt/format.h>

#include "app/lab_files.h"
#include "app/lane_option.h"
#include "app/shell_words.h"

namespace quartet {
namespace {

std::string camera_text(const Camera& camera) {
  std::string text;
  for (const glm::vec3 v : {camera.origin, camera.right, camera.up, camera.forward}) {
    for (int i = 0; i < 3; ++i) {
      text += fmt::format("{}{}", text.empty() ? "" : ",", v[i]);
    }
  }
  return text;
}

}  // namespace

std::string reproducing_command(const Snapshot& snapshot, const ViewSettings& view,
                                const std::string& scene, const std::string& folder) {
  const RenderSettings& settings = snapshot.settings;
  std::string command = "quartet figure " + shell_word(scene);
  command += fmt::format(" --frames {} --size {}x{} --integrator {} --seed {}", snapshot.frame,
                         settings.width, settings.height, integrator(settings.integrator).id,
                         settings.seed);
  if (settings.max_depth != snapshot.scene->scene().max_depth) {
    command += fmt::format(" --max-depth {}", settings.max_depth);
  }
  if (!(settings.camera == snapshot.scene->scene().camera)) {
    command += " --camera=" + camera_text(settings.camera);
  }
  for (const LaneSnapshot& lane : snapshot.lanes) {
    command += " --lane " + lane_text(lane.policy);
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

std::filesystem::path export_lab(const Snapshot& snapshot, const ViewSettings& view,
                                 const ExportForm& form, const std::string& scene) {
  Snapshot chosen = snapshot;
  if (form.lane >= 0 && std::size_t(form.lane) < snapshot.lanes.size()) {
    chosen.lanes = {snapshot.lanes[std::size_t(form.lane)]};
  }
  const std::string command = reproducing_command(chosen, view, scene, form.folder);
  StagedFiles files(form.folder);
  write_lab_files(files, chosen, view, command, std::nullopt);
  files.write("command.txt", command + "\n");
  files.commit();
  return std::filesystem::absolute(form.folder).lexically_normal();
}

}  // namespace quartet
