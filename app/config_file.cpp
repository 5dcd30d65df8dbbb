#include "app/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "renderer/image/staged_files.h"
#include "renderer/measure/metrics.h"
#include "ui/lab_layout.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

template <class Value>
void read(const ordered_json& json, const char* name, Value& value) {
  if (json.contains(name)) {
    value = json.at(name).get<Value>();
  }
}

void read_slots(const ordered_json& json, LabState& state) {
  for (std::size_t lane = 0; lane < std::min(json.size(), lane_count); ++lane) {
    for (std::size_t slot = 0; slot < std::min<std::size_t>(json[lane].size(), 2); ++slot) {
      const ordered_json& entry = json[lane][slot];
      SlotChoice& choice = state.slots[lane][slot];
      choice.kind = find_view(entry.at("view").get<std::string>()).key;
      choice.other = std::min(entry.value("other", std::size_t(0)), lane_count - 1);
    }
  }
}

void read_dock(const ordered_json& json, DockState& dock) {
  if (json.contains("open")) {
    dock.open = json.at("open").get<bool>();
  }
  read(json, "height", dock.height);
  dock.height = std::clamp(dock.height, 0.0f, 4096.0f);
  if (json.contains("against")) {
    dock.effort = find_effort(json.at("against").get<std::string>()).key;
  }
}

ordered_json dock_json(const DockState& dock) {
  ordered_json json;
  if (dock.open) {
    json["open"] = *dock.open;
  }
  json["height"] = dock.height;
  json["against"] = effort_row(dock.effort).id;
  return json;
}

void read_all(const ordered_json& json, LabState& state, WindowMemory& memory) {
  read(json, "width", memory.width);
  read(json, "height", memory.height);
  memory.width = std::clamp(memory.width, 960, 16384);
  memory.height = std::clamp(memory.height, 600, 16384);
  read(json, "ui_scale", state.ui_scale);
  if (!(state.ui_scale == 0.0f || (state.ui_scale >= 0.5f && state.ui_scale <= 8.0f))) {
    state.ui_scale = 0.0f;
  }
  read(json, "scene", state.scene);
  read(json, "exposure", state.view.exposure);
  if (json.contains("tone_map")) {
    state.view.tone_map = find_tone_map(json.at("tone_map").get<std::string>()).key;
  }
  state.view.heat =
      json.value("heat", "linked") == "report" ? HeatRange::report : HeatRange::linked;
  if (json.contains("layout")) {
    state.layout = find_layout(json.at("layout").get<std::string>()).key;
  }
  read(json, "export_folder", state.export_form.folder);
  if (json.contains("metric")) {
    state.request.metric = find_metric(json.at("metric").get<std::string>()).key;
  }
  if (json.contains("dock")) {
    read_dock(json.at("dock"), state.dock);
  }
  if (json.contains("slots")) {
    read_slots(json.at("slots"), state);
  }
}

}  // namespace

std::filesystem::path config_path() {
  const auto folder = [](const char* variable) -> std::filesystem::path {
    const char* const value = std::getenv(variable);
    return value && *value ? value : "";
  };
  std::filesystem::path base = folder("XDG_CONFIG_HOME");
  if (base.empty() && !folder("HOME").empty()) {
    base = folder("HOME") / ".config";
  }
  return base.empty() ? base : base / "quartet" / "settings.json";
}

std::string load_config(const std::filesystem::path& path, LabState& state, WindowMemory& memory) {
  std::ifstream file(path);
  if (!file) {
    return "";
  }
  // All or nothing: half of a broken file would be a state that nobody chose.
  LabState read_state = state;
  WindowMemory read_memory = memory;
  try {
    read_all(ordered_json::parse(file), read_state, read_memory);
  } catch (const std::exception& error) {
    return fmt::format("{}: not used: {}", path.string(), error.what());
  }
  state = std::move(read_state);
  memory = read_memory;
  return "";
}

void save_config(const std::filesystem::path& path, const LabState& state,
                 const WindowMemory& memory) {
  ordered_json json;
  json["width"] = memory.width;
  json["height"] = memory.height;
  json["ui_scale"] = state.ui_scale;
  json["scene"] = state.scene;
  json["layout"] = layout_row(state.layout).id;
  json["exposure"] = state.view.exposure;
  json["tone_map"] = tone_map_row(state.view.tone_map).id;
  json["heat"] = state.view.heat == HeatRange::linked ? "linked" : "report";
  json["export_folder"] = state.export_form.folder;
  json["metric"] = metric(state.request.metric).id;
  json["dock"] = dock_json(state.dock);
  for (const LaneSlots& slots : state.slots) {
    ordered_json lane;
    for (const SlotChoice& choice : slots) {
      lane.push_back({{"view", view_row(choice.kind).id}, {"other", choice.other}});
    }
    json["slots"].push_back(std::move(lane));
  }
  StagedFiles files(path.parent_path());
  files.write(path.filename().string(), json.dump(2) + "\n");
  files.commit();
}

}  // namespace quartet
