#include "renderer/scene/xml_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include "renderer/scene/number.h"

namespace quartet {
namespace {

std::string read_text(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw SceneError(fmt::format("{}: is a folder, not a scene file", path.string()));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    throw SceneError(fmt::format("{}: cannot read the scene file: {}", path.string(),
                                 errno != 0 ? std::strerror(errno) : "input error"));
  }
  return text;
}

void for_each_element(pugi::xml_node node, const std::function<void(pugi::xml_node)>& visit) {
  for (pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    visit(child);
    for_each_element(child, visit);
  }
}

/// The name behind a '$', for a message or for the list of parameters that a scene uses.
std::string_view identifier(std::string_view text) {
  const auto* end = std::find_if_not(
      text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return text.substr(0, std::size_t(end - text.begin()));
}

std::string list_or(const std::set<std::string>& names, std::string_view none) {
  return names.empty() ? std::string(none) : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

XmlDocument::XmlDocument(const std::filesystem::path& path, const SceneParameters& overrides)
    : path_(path) {
  const std::string text = read_text(path);
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts_.push_back(std::ptrdiff_t(i) + 1);
  }
  const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
  if (!result) {
    throw SceneError(fmt::format("{}:{}: not well-formed XML: {}", path_.string(),
                                 line(result.offset), result.description()));
  }
  if (std::string_view(root().name()) != "scene") {
    fail(root(), fmt::format("the root element is <{}>, expected <scene version=\"3.0.0\">",
                             root().name()));
  }
  check_dialect();
  replace_parameters(overrides);
  collect_ids();
}

int XmlDocument::line(std::ptrdiff_t offset) const {
  return int(std::upper_bound(line_starts_.begin(), line_starts_.end(), offset) -
             line_starts_.begin());
}

int XmlDocument::line(pugi::xml_node node) const {
  return line(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
}

std::string XmlDocument::where(pugi::xml_node node) const {
  return fmt::format("{}:{}", path_.string(), line(node));
}

void XmlDocument::fail(pugi::xml_node node, std::string_view message) const {
  throw SceneError(fmt::format("{}: {}", where(node), message));
}

void XmlDocument::check_dialect() const {
  const std::string_view version = root().attribute("version").value();
  const std::string_view major = version.substr(0, version.find('.'));
  const std::optional<double> number = parse_number(major);
  if (!number) {
    fail(root(), fmt::format("version \"{}\" is not a version, expected <scene version=\"3.0.0\">",
                             version));
  }
  if (*number < 1.0) {
    fail(root(),
         fmt::format("version {} is the dialect of Mitsuba 0.x; convert the file to Mitsuba 3 "
                     "(loading it once there with the option to write the update does that)",
                     version));
  }
}

void XmlDocument::replace_parameters(const SceneParameters& overrides) {
  std::map<std::string, std::string> values = overrides;
  std::set<std::string> names;  // what the scene knows: its <default> elements and every $name

  const auto replace = [&](pugi::xml_node node, std::string_view text) {
    std::string result;
    for (std::size_t at = text.find('$'); at != std::string_view::npos; at = text.find('$')) {
      result += text.substr(0, at);
      text.remove_prefix(at + 1);
      // The longest name wins, so that "$width2" is not read as "$width" followed by 2.
      const std::pair<const std::string, std::string>* best = nullptr;
      for (const auto& entry : values) {
        if (text.starts_with(entry.first) &&
            (best == nullptr || entry.first.size() > best->first.size())) {
          best = &entry;
        }
      }
      if (best == nullptr) {
        std::set<std::string> known;
        for (const auto& entry : values) known.insert(entry.first);
        fail(node, fmt::format("parameter '${}' has no value; give it one with -D {}=... or a "
                               "<default> (defined: {})",
                               identifier(text), identifier(text), list_or(known, "none")));
      }
      names.insert(best->first);
      result += best->second;
      text.remove_prefix(best->first.size());
    }
    return result.append(text);
  };

  // Defaults first, so that a parameter may be used above the line that defines it.
  for_each_element(root(), [&](pugi::xml_node node) {
    if (std::string_view(node.name()) != "default") return;
    const std::string name = node.attribute("name").value();
    if (name.empty()) fail(node, "<default> needs a name");
    names.insert(name);
    if (!values.contains(name)) values[name] = replace(node, node.attribute("value").value());
  });
  for_each_element(root(), [&](pugi::xml_node node) {
    if (std::string_view(node.name()) == "default") return;
    for (pugi::xml_attribute attribute : node.attributes()) {
      const std::string_view value = attribute.value();
      if (value.find('$') == std::string_view::npos) continue;
      attribute.set_value(replace(node, value).c_str());
    }
  });
  for (const auto& [name, value] : overrides) {
    if (names.contains(name)) continue;
    throw ParameterError(fmt::format("{}: has no parameter '{}' (its parameters: {})",
                                     path_.string(), name, list_or(names, "none")));
  }
}

void XmlDocument::collect_ids() {
  for_each_element(root(), [&](pugi::xml_node node) {
    const std::string id = node.attribute("id").value();
    if (id.empty() || std::string_view(node.name()) == "ref") return;
    const auto [entry, is_new] = ids_.emplace(id, node);
    if (!is_new) {
      fail(node, fmt::format("id '{}' is already used in line {}", id, line(entry->second)));
    }
  });
}

pugi::xml_node XmlDocument::target(pugi::xml_node reference) const {
  const std::string id = reference.attribute("id").value();
  const auto entry = ids_.find(id);
  if (entry != ids_.end()) return entry->second;
  std::set<std::string> known;
  for (const auto& [name, node] : ids_) known.insert(name);
  fail(reference, fmt::format("nothing has the id '{}' (ids: {})", id, list_or(known, "none")));
}

}  // namespace quartet
