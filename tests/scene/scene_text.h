#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "renderer/scene/load_scene.h"

namespace quartet::test {

/// A folder that lasts as long as the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "quartet-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(std::string_view name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline constexpr std::string_view sensor =
    R"(<sensor type="perspective"><float name="fov" value="40"/></sensor>)";
inline constexpr std::string_view sky = R"(<emitter type="constant"/>)";

/// A whole scene file: `body` starts in line 2; a camera and a light follow it.
inline std::string scene_text(std::string_view body) {
  return std::string("<scene version=\"3.0.0\">\n")
      .append(body)
      .append("\n")
      .append(sensor)
      .append(sky)
      .append("</scene>\n");
}

inline Scene load_text(std::string_view text, const SceneParameters& parameters = {}) {
  const TemporaryFolder folder;
  return load_scene(folder.write("scene.xml", text), parameters);
}

/// The material of a shape, which must be of this kind.
template <class Kind>
const Kind& kind_of(const Scene& scene, const Shape& shape) {
  return std::get<Kind>(scene.materials.at(std::size_t(shape.material)).kind);
}

/// Loads `body` with a camera and a light.
inline Scene load_body(std::string_view body, const SceneParameters& parameters = {}) {
  return load_text(scene_text(body), parameters);
}

/// The message of the SceneError that `text` causes, without the folder of the file. It fails the
/// test if there is none, or if it is not one line.
inline std::string error_of_text(std::string_view text, const SceneParameters& parameters = {}) {
  const TemporaryFolder folder;
  try {
    load_scene(folder.write("scene.xml", text), parameters);
  } catch (const SceneError& error) {
    std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = message.find(prefix); at != std::string::npos;
         at = message.find(prefix)) {
      message.erase(at, prefix.size());
    }
    return message;
  }
  ADD_FAILURE() << "no SceneError from: " << text;
  return {};
}

inline std::string error_of(std::string_view body, const SceneParameters& parameters = {}) {
  return error_of_text(scene_text(body), parameters);
}

/// The file name and line of a warning or error are right, and it says `text`.
inline void expect_message(const std::string& message, int line, std::string_view text) {
  EXPECT_NE(message.find("scene.xml:" + std::to_string(line) + ": "), std::string::npos) << message;
  EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks: " << text;
}

inline void expect_one_warning(const Scene& scene, int line, std::string_view text) {
  ASSERT_EQ(scene.warnings.size(), 1u);
  expect_message(scene.warnings[0], line, text);
}

inline void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

inline const Mesh& mesh_of(const Scene& scene, std::size_t shape = 0) {
  return std::get<Mesh>(scene.shapes.at(shape).geometry);
}

/// Unit normal of the front of a triangle.
inline glm::vec3 front(const Mesh& mesh, std::size_t triangle = 0) {
  const glm::uvec3 t = mesh.triangles.at(triangle);
  return glm::normalize(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                   mesh.positions[t.z] - mesh.positions[t.x]));
}

inline const Shape& shape_of(const Scene& scene, std::string_view id) {
  for (const Shape& shape : scene.shapes) {
    if (shape.id == id) return shape;
  }
  throw std::out_of_range("no shape " + std::string(id));
}

}  // namespace quartet::test
