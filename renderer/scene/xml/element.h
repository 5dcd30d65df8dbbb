#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/xml/scene_builder.h"

namespace quartet {

/// One object of the scene file (a shape, a bsdf, ...): reads its properties by name and remembers
/// which of its children were asked for, so that the others can be warned about. All functions
/// throw SceneError on a value of the wrong kind. Reading one takes time linear in its children.
class Element {
 public:
  /// Throws Cancelled once the loading was asked to stop.
  Element(SceneBuilder& builder, pugi::xml_node node);

  pugi::xml_node node() const { return node_; }
  std::string_view type() const { return node_.attribute("type").value(); }
  std::string id() const;     ///< printable
  std::string title() const;  ///< "shape 'sphere'", for messages

  bool has(std::string_view name) const;
  double number(std::string_view name, double fallback);
  /// A number that must be above 0.
  double positive(std::string_view name, double fallback);
  int integer(std::string_view name, int fallback);
  bool boolean(std::string_view name, bool fallback);
  std::string text(std::string_view name, std::string_view fallback);
  glm::dvec3 point(std::string_view name, const glm::dvec3& fallback);
  /// Affine and invertible; identity if absent.
  glm::dmat4 transform(std::string_view name);

  /// The child with this name, a null node if there is none. Its tag must be one of `tags`.
  pugi::xml_node property(std::string_view name, std::initializer_list<std::string_view> tags);
  /// The nested objects with this tag, those that a <ref> points to among them, in file order.
  std::vector<pugi::xml_node> objects(std::string_view tag);

  /// Properties that are known but mean nothing here.
  void ignore(std::initializer_list<std::string_view> names);
  /// Warns about every child that was not asked for.
  void warn_unused();

  [[noreturn]] void fail(std::string_view message) const { builder_->xml.fail(node_, message); }
  void warn(std::string_view message) { builder_->warn(node_, message); }

 private:
  SceneBuilder* builder_;
  pugi::xml_node node_;
  std::set<pugi::xml_node> used_;
};

}  // namespace quartet
