#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/load_scene.h"

namespace quartet {

/// A parsed scene file whose `$name` parameters are replaced, and which knows the line of each
/// element and the element of each id.
class XmlDocument {
 public:
  /// Throws SceneError: unreadable file, broken XML, the dialect of Mitsuba 0.x, an undefined
  /// parameter, an override of a parameter that the scene never uses, an id given twice.
  XmlDocument(const std::filesystem::path& path, const SceneParameters& overrides);

  const std::filesystem::path& path() const { return path_; }
  pugi::xml_node root() const { return document_.document_element(); }
  int line(pugi::xml_node node) const;
  std::string where(pugi::xml_node node) const;  ///< "file:line"

  /// Throws SceneError "file:line: message".
  [[noreturn]] void fail(pugi::xml_node node, std::string_view message) const;

  /// The element that a <ref> means, wherever in the file it stands. Throws SceneError that lists
  /// the ids.
  pugi::xml_node target(pugi::xml_node reference) const;

 private:
  int line(std::ptrdiff_t offset) const;
  void check_dialect() const;
  void replace_parameters(const SceneParameters& overrides);
  void collect_ids();

  std::filesystem::path path_;
  std::vector<std::ptrdiff_t> line_starts_;
  pugi::xml_document document_;
  std::map<std::string, pugi::xml_node, std::less<>> ids_;
};

}  // namespace quartet
