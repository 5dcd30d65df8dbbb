#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

#include "renderer/scene/load_scene.h"

namespace quartet {

std::vector<std::string> builtin_scenes() {
  std::vector<std::string> names;
  std::error_code error;  // a program moved away from its scenes has none
  for (const auto& entry : std::filesystem::directory_iterator(QUARTET_SCENES_DIR, error)) {
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path find_scene(std::string_view name) {
  std::error_code error;
  std::filesystem::path path(name);
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error)) {
    return path;
  }
  std::string_view short_name = name;
  if (short_name.starts_with("scenes/")) short_name.remove_prefix(7);
  if (short_name.ends_with(".xml")) short_name.remove_suffix(4);
  const std::vector<std::string> names = builtin_scenes();
  if (std::find(names.begin(), names.end(), short_name) == names.end()) {
    throw SceneError(fmt::format("{}: no such scene; expected a Mitsuba 3 XML file or one of {}",
                                 name, fmt::join(names, ", ")));
  }
  return std::filesystem::path(QUARTET_SCENES_DIR) / fmt::format("{}.xml", short_name);
}

}  // namespace quartet
