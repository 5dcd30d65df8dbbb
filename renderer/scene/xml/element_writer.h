#pragma once

#include <glm/glm.hpp>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/color.h"
#include "renderer/scene/textures/texture.h"
#include "renderer/scene/write_scene.h"

namespace quartet {

/// What the writers of a scene file's parts share.
struct SceneWriting {
  const Scene& scene;
  std::string stem;                       ///< of all files' names
  std::vector<SceneFile> meshes;          ///< those written so far
  std::vector<std::string> texture_ids;   ///< of scene.textures; empty until it stands in the file
  std::vector<std::string> material_ids;  ///< the same of scene.materials
  std::set<std::string, std::less<>> ids;

  /// An id that the file does not have yet: `wanted` if it can be.
  std::string new_id(const std::string& wanted);
};

/// One object of a scene file being written: what Element reads. Numbers come back to the bit.
class ElementWriter {
 public:
  ElementWriter(SceneWriting& writing, pugi::xml_node node) : writing_(&writing), node_(node) {}

  SceneWriting& writing() { return *writing_; }
  /// An object in this one.
  ElementWriter object(std::string_view tag, std::string_view type = {});
  void set_type(std::string_view type) { attribute("type", type); }
  void set_id(const std::string& id) { attribute("id", id); }
  /// A reference to an object that stands further up in the file; with a name where it is a value.
  void refer(const std::string& id, std::string_view name = {});

  void number(std::string_view name, float value);
  void integer(std::string_view name, int value);
  void boolean(std::string_view name, bool value);
  void text(std::string_view name, std::string_view value);
  void point(std::string_view name, glm::vec3 value);
  void color(std::string_view name, glm::vec3 value);
  /// Also of a texture, which stands where it is used first.
  void color(std::string_view name, const Color& value);
  void transform(std::string_view name, const glm::dmat4& value);
  /// Of texture coordinates.
  void transform(std::string_view name, const glm::mat3& value);

 private:
  pugi::xml_node property(std::string_view tag, std::string_view name, std::string_view text);
  void attribute(const char* name, std::string_view text);

  SceneWriting* writing_;
  pugi::xml_node node_;
};

}  // namespace quartet
