#include "app/window/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "app/records/json_text.h"
#include "renderer/base/printable.h"
#include "renderer/base/regular_file.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/metrics.h"
#include "ui/window/lab_layout.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_bytes = std::size_t(1) << 20;
constexpr int most_levels = 16;

/// Reads the file's values, and collects what is wrong with single numbers.
class SettingsReader {
 public:
  template <class Value>
  void read(const ordered_json& json, const char* name, Value& value) const {
    if (json.contains(name)) {
      value = json.at(name).get<Value>();
    }
  }

  /// A number that is not in the range leaves the value as it is.
  template <class Number>
  void read_number(const ordered_json& json, const char* name, Number low, Number high,
                   Number& value) {
    if (!json.contains(name)) {
      return;
    }
    const ordered_json& given = json.at(name);
    const double number = given.is_number() ? given.get<double>() : std::nan("");
    const bool whole = !std::is_integral_v<Number> || number == std::floor(number);
    if (number >= double(low) && number <= double(high) && whole) {
      value = Number(number);
      return;
    }
    complaints_ += fmt::format("{}'{}' is {}; a {}number from {} to {} would be right",
                               complaints_.empty() ? "" : ", ", name,
                               given.is_number() ? given.dump() : "no number",
                               std::is_integral_v<Number> ? "whole " : "", low, high);
  }

  const std::string& complaints() const { return complaints_; }

 private:
  std::string complaints_;
};

void read_slots(const ordered_json& json, LabState& state, SettingsReader& reader) {
  for (std::size_t lane = 0; lane < std::min(json.size(), lane_count); ++lane) {
    for (std::size_t slot = 0; slot < std::min<std::size_t>(json[lane].size(), 2); ++slot) {
      const ordered_json& entry = json[lane][slot];
      SlotChoice& choice = state.slots[lane][slot];
      choice.kind = find_view(entry.at("view").get<std::string>()).key;
      choice.other = 0;
      reader.read_number(entry, "other", std::size_t(0), lane_count - 1, choice.other);
    }
  }
}

void read_dock(const ordered_json& json, DockState& dock, SettingsReader& reader) {
  if (json.contains("open")) {
    dock.open = json.at("open").get<bool>();
  }
  reader.read_number(json, "height", 0.0f, 4096.0f, dock.height);
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

void read_all(const ordered_json& json, LabState& state, WindowMemory& memory,
              SettingsReader& reader) {
  if (!json.is_object()) {
    throw std::runtime_error("names with values, as the window writes them, would be right");
  }
  reader.read_number(json, "width", 960, 16384, memory.width);
  reader.read_number(json, "height", 600, 16384, memory.height);
  if (json.value("ui_scale", ordered_json()) != 0) {  // the monitor's
    reader.read_number(json, "ui_scale", 0.5f, 8.0f, state.ui_scale);
  }
  reader.read(json, "scene", state.scene);
  reader.read_number(json, "exposure", -64.0f, 64.0f, state.view.exposure);
  if (json.contains("tone_map")) {
    state.view.tone_map = find_tone_map(json.at("tone_map").get<std::string>()).key;
  }
  state.view.heat =
      json.value("heat", "linked") == "report" ? HeatRange::report : HeatRange::linked;
  if (json.contains("layout")) {
    state.layout = find_layout(json.at("layout").get<std::string>()).key;
  }
  reader.read(json, "export_folder", state.export_form.folder);
  if (json.contains("metric")) {
    state.request.lanes.metric = find_metric(json.at("metric").get<std::string>()).key;
  }
  if (json.contains("dock")) {
    read_dock(json.at("dock"), state.dock, reader);
  }
  if (json.contains("slots")) {
    read_slots(json.at("slots"), state, reader);
  }
}

ordered_json parsed(const std::string& text) {
  const ordered_json::parser_callback_t shallow = [](int level, ordered_json::parse_event_t,
                                                     ordered_json&) {
    if (level > most_levels) {
      throw std::runtime_error(fmt::format("it is more than {} levels deep", most_levels));
    }
    return true;
  };
  return ordered_json::parse(text, shallow);
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
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return "";
  }
  // All or nothing: half of a broken file would be a state that nobody chose. A number out of range
  // alone leaves the others as they were chosen.
  LabState read_state = state;
  WindowMemory read_memory = memory;
  SettingsReader reader;
  try {
    read_all(parsed(read_regular_file(path, most_bytes)), read_state, read_memory, reader);
  } catch (const std::exception& error) {
    return printable(fmt::format("{}: not used: {}", path.string(), error.what()));
  }
  state = std::move(read_state);
  memory = read_memory;
  return reader.complaints().empty()
             ? ""
             : printable(fmt::format("{}: not used: {}", path.string(), reader.complaints()));
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
  json["metric"] = metric(state.request.lanes.metric).id;
  json["dock"] = dock_json(state.dock);
  for (const LaneSlots& slots : state.slots) {
    ordered_json lane;
    for (const SlotChoice& choice : slots) {
      lane.push_back({{"view", view_row(choice.kind).id}, {"other", choice.other}});
    }
    json["slots"].push_back(std::move(lane));
  }
  StagedFiles files(path.parent_path());
  files.write(path.filename().string(), json_text(json) + "\n");
  files.commit();
}

}  // namespace quartet
