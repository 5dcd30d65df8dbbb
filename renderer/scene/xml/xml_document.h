#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <pugixml.hpp>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/load_scene.h"

namespace quartet {

/// A parsed scene file whose `$name` parameters are replaced, and which knows the line of each
/// element and the element of each id. A file may be as odd as it likes: what it can ask for is
/// limited in size, depth and number, and each limit names itself.
class XmlDocument {
 public:
  /// How deep elements may stand in one another, by nesting or by reference.
  static constexpr int deepest = 256;
  static constexpr std::size_t longest_message = 2000;  ///< bytes; the rest is cut

  /// Throws SceneError: unreadable file, broken XML, the dialect of Mitsuba 0.x, an undefined
  /// parameter, an override of a parameter that the scene never uses, an id given twice, a limit
  /// passed. Throws Cancelled once `stop` is asked for.
  XmlDocument(const std::filesystem::path& path, const SceneParameters& overrides,
              const std::stop_token& stop = {});

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
  void parse(const std::stop_token& stop);
  void check_depth(const std::stop_token& stop) const;
  void check_dialect() const;
  void replace_parameters(const SceneParameters& overrides, const std::stop_token& stop);
  void collect_ids(const std::stop_token& stop);

  std::filesystem::path path_;
  std::vector<std::ptrdiff_t> line_starts_;
  pugi::xml_document document_;
  std::map<std::string, pugi::xml_node, std::less<>> ids_;
  mutable std::size_t referred_ = 0;  // elements that references led to, each time anew
};

}  // namespace quartet
