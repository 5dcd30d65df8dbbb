#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/excerpt.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/xml/xml_document.h"

namespace quartet {

/// What the readers of a scene file's parts share: the file, and the scene as far as it is read.
struct SceneBuilder {
  SceneBuilder(const std::filesystem::path& path, const SceneParameters& parameters,
               const std::stop_token& stop_token)
      : stop(stop_token), xml(path, parameters, stop_token) {}

  /// Adds "file:line: message" to the scene's warnings; the same message for a later line is not
  /// repeated, and after so many the last one says that there are more.
  void warn(pugi::xml_node node, std::string_view message) {
    if (warned.size() > most_warnings || !warned.emplace(message).second) return;
    const std::string text =
        warned.size() > most_warnings
            ? fmt::format("more than {} warnings, the rest is not shown", most_warnings)
            : excerpt(message, XmlDocument::longest_message);
    scene.warnings.push_back(fmt::format("{}: {}", xml.where(node), text));
  }

  /// Throw SceneError once there are too many.
  void count_triangles(pugi::xml_node node, std::size_t count) {
    count_up(node, triangles, count, most_triangles, "triangles");
  }
  void count_lights(pugi::xml_node node, std::size_t count) {
    count_up(node, lights, count, most_lights, "lights (each triangle that shines is one)");
  }

  std::stop_token stop;  ///< asks the loading to end
  XmlDocument xml;
  Scene scene;
  std::map<pugi::xml_node, int> materials;   ///< elements already read, index into scene.materials
  std::map<pugi::xml_node, int> textures;    ///< the same for scene.textures
  std::vector<pugi::xml_node> delta_lights;  ///< where those of scene.delta_lights stand
  int default_material = -1;                 ///< index into scene.materials, -1 until needed
  std::set<pugi::xml_node> integrators;      ///< already read
  std::size_t triangles = 0;                 ///< of all meshes
  std::size_t lights = 0;                    ///< a triangle that shines is one
  std::vector<pugi::xml_node> open;          ///< elements being read, see OpenElement
  std::set<std::string, std::less<>> warned;

 private:
  void count_up(pugi::xml_node node, std::size_t& sum, std::size_t count, std::size_t most,
                std::string_view what) const {
    sum += count;
    if (sum > most) {
      xml.fail(node, fmt::format("more than {} {} in all, which is the limit", most, what));
    }
  }
};

/// Marks an element as being read. Throws SceneError if it already is: a <ref> in it leads back to
/// it; and if one leads to the next too often.
class OpenElement {
 public:
  OpenElement(SceneBuilder& builder, pugi::xml_node node) : builder_(builder) {
    if (std::find(builder.open.begin(), builder.open.end(), node) != builder.open.end()) {
      builder.xml.fail(node, "refers to itself");
    }
    if (builder.open.size() >= std::size_t(XmlDocument::deepest)) {
      builder.xml.fail(node, fmt::format("references lead from one element to the next more than "
                                         "{} times, which is the limit",
                                         XmlDocument::deepest));
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
