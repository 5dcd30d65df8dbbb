#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "renderer/base/printable.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr std::string_view synthetic_prefix = "synthetic:";

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error);
}

/// The name of a built-in scene without what may stand around it.
std::string builtin_name(std::string_view name) {
  std::string_view bare = name;
  if (bare.starts_with("scenes/")) bare.remove_prefix(7);
  if (bare.ends_with(".xml")) bare.remove_suffix(4);
  const std::vector<std::string> names = builtin_scenes();
  if (std::find(names.begin(), names.end(), bare) == names.end()) {
    throw SceneError(fmt::format("{}: no such scene; expected a Mitsuba 3 XML file or one of {}",
                                 printable(name), fmt::join(names, ", ")));
  }
  return std::string(bare);
}

}  // namespace

std::vector<std::string> builtin_scenes() {
  std::vector<std::string> names;
  std::error_code error;  // a program moved away from its scenes has none
  const std::filesystem::path folder = QUARTET_SCENES_DIR;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
    if (entry.path().extension() != ".xml") continue;
    names.push_back(entry.path().lexically_relative(folder).replace_extension().generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path find_scene(std::string_view name) {
  if (is_file(name)) return name;
  return std::filesystem::path(QUARTET_SCENES_DIR) / (builtin_name(name) + ".xml");
}

std::string lasting_scene_name(std::string_view name) {
  if (name.starts_with(synthetic_prefix)) {
    return synthetic_scene(find_synthetic(name.substr(synthetic_prefix.size()))).name;
  }
  return is_file(name) ? std::filesystem::absolute(name).string() : builtin_name(name);
}

Scene open_scene(std::string_view name, const SceneParameters& parameters, std::stop_token stop) {
  if (name.starts_with(synthetic_prefix)) {
    if (!parameters.empty()) {
      throw ParameterError(fmt::format("{}: takes no parameters, '{}' is one", printable(name),
                                       printable(parameters.begin()->first)));
    }
    return synthetic_scene(find_synthetic(name.substr(synthetic_prefix.size())));
  }
  Scene scene = load_scene(find_scene(name), parameters, std::move(stop));
  if (!is_file(name)) scene.name = builtin_name(name);
  return scene;
}

}  // namespace quartet
