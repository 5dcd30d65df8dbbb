#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.h"

namespace quartet {

/// A scene that cannot be rendered. what() is one line: file, line, what was wrong and what would
/// be right.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Values for the `$name` parameters of a scene file; they win over its `<default>` elements.
using SceneParameters = std::map<std::string, std::string>;

/// Reads a Mitsuba 3 XML file. What is unknown but harmless is left out and named in
/// Scene::warnings, once each. Throws SceneError.
Scene load_scene(const std::filesystem::path& path, const SceneParameters& parameters = {});

/// The scenes that come with Quartet: names without folder and extension, sorted.
std::vector<std::string> builtin_scenes();

/// The file meant by `name`: the path itself if it exists, else the built-in scene of that name
/// (with or without "scenes/" before and ".xml" behind it). Throws SceneError that lists the
/// built-in scenes.
std::filesystem::path find_scene(std::string_view name);

}  // namespace quartet
