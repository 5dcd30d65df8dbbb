#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/scene/xml_document.h"

namespace quartet {

/// What the readers of a scene file's parts share: the file, and the scene as far as it is read.
struct SceneBuilder {
  SceneBuilder(const std::filesystem::path& path, const SceneParameters& parameters)
      : xml(path, parameters) {}

  /// Adds "file:line: message" to the scene's warnings; the same message for a later line is not
  /// repeated.
  void warn(pugi::xml_node node, std::string_view message) {
    if (warned.emplace(message).second) {
      scene.warnings.push_back(xml.where(node).append(": ").append(message));
    }
  }

  XmlDocument xml;
  Scene scene;
  std::map<pugi::xml_node, int> materials;  ///< elements already read, index into scene.materials
  std::map<pugi::xml_node, int> textures;   ///< the same for scene.textures
  int default_material = -1;                ///< index into scene.materials, -1 until needed
  std::vector<pugi::xml_node> open;         ///< elements being read, see OpenElement
  std::set<std::string, std::less<>> warned;
};

/// Marks an element as being read. Throws SceneError if it already is: a <ref> in it leads back to
/// it.
class OpenElement {
 public:
  OpenElement(SceneBuilder& builder, pugi::xml_node node) : builder_(builder) {
    if (std::find(builder.open.begin(), builder.open.end(), node) != builder.open.end()) {
      builder.xml.fail(node, "refers to itself");
    }
    builder.open.push_back(node);
  }
  ~OpenElement() { builder_.open.pop_back(); }
  OpenElement(const OpenElement&) = delete;
  OpenElement& operator=(const OpenElement&) = delete;

 private:
  SceneBuilder& builder_;
};

}  // namespace quartet
