#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <stop_token>
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

/// A parameter that the scene does not have.
struct ParameterError : SceneError {
  using SceneError::SceneError;
};

/// Values for the `$name` parameters of a scene file; they win over its `<default>` elements.
using SceneParameters = std::map<std::string, std::string>;

/// Reads a Mitsuba 3 XML file. What is unknown but harmless is left out and named in
/// Scene::warnings, once each. Throws SceneError, ParameterError among them, and Cancelled within a
/// tenth of a second or so after `stop` was asked for.
Scene load_scene(const std::filesystem::path& path, const SceneParameters& parameters = {},
                 std::stop_token stop = {});

/// The scenes that come with Quartet: names without extension, sorted, those that show where
/// methods fail with their folder ("failures/rare-light").
std::vector<std::string> builtin_scenes();

/// The file meant by `name`: the path itself if it exists, else the built-in scene of that name
/// (with or without "scenes/" before and ".xml" behind it). Throws SceneError that lists the
/// built-in scenes.
std::filesystem::path find_scene(std::string_view name);

/// What `name` is called wherever the program runs: a file's absolute path, a built-in scene's
/// name, or "synthetic:ID". Throws like open_scene, without reading the file.
std::string lasting_scene_name(std::string_view name);

/// The scene meant by `name`: a file or a built-in scene as above, or "synthetic:ID", a
/// distribution of synthetic.h, which takes no parameters. Throws SceneError, Cancelled as above,
/// or std::invalid_argument that lists the distributions.
Scene open_scene(std::string_view name, const SceneParameters& parameters = {},
                 std::stop_token stop = {});

}  // namespace quartet
