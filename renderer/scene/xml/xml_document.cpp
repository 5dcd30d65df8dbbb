#include "renderer/scene/xml/xml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <set>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "renderer/base/printable.h"
#include "renderer/base/regular_file.h"
#include "renderer/scene/xml/number.h"

namespace quartet {
namespace {

constexpr std::size_t largest_file = std::size_t(64) << 20;  // bytes
constexpr std::size_t most_elements = 1'000'000;
constexpr std::size_t longest_value = std::size_t(64) << 10;  // bytes, with parameters replaced
constexpr std::size_t most_replaced = std::size_t(16) << 20;  // bytes of all such values
constexpr std::size_t longest_name = 64;                      // of a parameter, bytes
constexpr std::size_t most_referred = 8'000'000;

/// Calls visit(element, depth) for each element of a tree, without recursion.
template <class Visit>
class ElementWalk : public pugi::xml_tree_walker {
 public:
  ElementWalk(Visit visit, const std::stop_token& stop) : visit_(std::move(visit)), stop_(stop) {}

  bool for_each(pugi::xml_node& node) override {
    if (node.type() == pugi::node_element) {
      check_cancelled(stop_);
      visit_(node, depth());
    }
    return true;
  }

 private:
  Visit visit_;
  std::stop_token stop_;
};

/// The root, which stands at depth 0, is not visited.
template <class Visit>
void for_each_element(pugi::xml_node root, const std::stop_token& stop, Visit visit) {
  ElementWalk<Visit> walk(std::move(visit), stop);
  root.traverse(walk);
}

/// The name behind a '$', for a message.
std::string_view identifier(std::string_view text) {
  const auto* end = std::find_if_not(
      text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return text.substr(0, std::size_t(end - text.begin()));
}

/// The values of `$name` parameters, found by the longest name: "$width2" is not "$width" and a 2.
class ParameterValues {
 public:
  using Entry = std::pair<const std::string, std::string>;

  bool contains(const std::string& name) const { return values_.contains(name); }
  void add(const std::string& name, std::string value) {
    if (name.size() <= longest_name) has_length_[name.size()] = true;
    values_.emplace(name, std::move(value));
  }
  /// Null if no name stands at the beginning of `text`.
  const Entry* find(std::string_view text) const {
    for (std::size_t length = std::min(longest_name, text.size()); length > 0; --length) {
      if (!has_length_[length]) continue;
      const auto entry = values_.find(text.substr(0, length));
      if (entry != values_.end()) return &*entry;
    }
    return nullptr;
  }
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names;
    for (const auto& [name, value] : values_) names.push_back(name);
    return names;
  }

 private:
  std::map<std::string, std::string, std::less<>> values_;
  std::array<bool, longest_name + 1> has_length_{};
};

}  // namespace

XmlDocument::XmlDocument(const std::filesystem::path& path, const SceneParameters& overrides,
                         const std::stop_token& stop)
    : path_(path) {
  parse(stop);
  if (std::string_view(root().name()) != "scene") {
    fail(root(), fmt::format("the root element is <{}>, expected <scene version=\"3.0.0\">",
                             excerpt(root().name())));
  }
  check_depth(stop);
  check_dialect();
  replace_parameters(overrides, stop);
  collect_ids(stop);
}

void XmlDocument::parse(const std::stop_token& stop) {
  std::string text;
  try {
    text = read_regular_file(path_, largest_file, stop);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw SceneError(printable(error.what()));
  }
  const std::string name = printable(path_.string());
  line_starts_.push_back(0);
  std::size_t elements = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts_.push_back(std::ptrdiff_t(i) + 1);
    if (text[i] == '<' && i + 1 < text.size() && text[i + 1] != '/') ++elements;
    if (text[i] == '\0') {
      throw SceneError(fmt::format("{}:{}: a byte of value 0, expected XML in UTF-8", name,
                                   line(std::ptrdiff_t(i))));
    }
  }
  if (elements > most_elements) {
    throw SceneError(
        fmt::format("{}: {} elements, at most {} are possible", name, elements, most_elements));
  }
  check_cancelled(stop);
  const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
  if (!result) {
    throw SceneError(fmt::format("{}:{}: not well-formed XML: {}", name, line(result.offset),
                                 result.description()));
  }
}

int XmlDocument::line(std::ptrdiff_t offset) const {
  return int(std::upper_bound(line_starts_.begin(), line_starts_.end(), offset) -
             line_starts_.begin());
}

int XmlDocument::line(pugi::xml_node node) const {
  return line(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
}

std::string XmlDocument::where(pugi::xml_node node) const {
  return fmt::format("{}:{}", printable(path_.string()), line(node));
}

void XmlDocument::fail(pugi::xml_node node, std::string_view message) const {
  throw SceneError(fmt::format("{}: {}", where(node), excerpt(message, longest_message)));
}

void XmlDocument::check_depth(const std::stop_token& stop) const {
  for_each_element(root(), stop, [&](pugi::xml_node node, int depth) {
    if (depth >= deepest) {
      fail(node, fmt::format("<{}> stands more than {} elements deep, which is the limit",
                             excerpt(node.name()), deepest));
    }
  });
}

void XmlDocument::check_dialect() const {
  const std::string_view version = root().attribute("version").value();
  const std::string_view major = version.substr(0, version.find('.'));
  const std::optional<double> number = parse_number(major);
  if (!number) {
    fail(root(), fmt::format("version \"{}\" is not a version, expected <scene version=\"3.0.0\">",
                             excerpt(version)));
  }
  if (*number < 1.0) {
    fail(root(),
         fmt::format("version {} is the dialect of Mitsuba 0.x; convert the file to Mitsuba 3 "
                     "(loading it once there with the option to write the update does that)",
                     excerpt(version)));
  }
}

void XmlDocument::replace_parameters(const SceneParameters& overrides,
                                     const std::stop_token& stop) {
  ParameterValues values;
  for (const auto& [name, value] : overrides) values.add(name, value);
  std::set<std::string> names;  // what the scene knows: its <default> elements and every $name
  std::size_t replaced = 0;

  const auto replace = [&](pugi::xml_node node, std::string_view text) {
    std::string result;
    for (std::size_t at = text.find('$'); at != std::string_view::npos; at = text.find('$')) {
      result += text.substr(0, at);
      text.remove_prefix(at + 1);
      const ParameterValues::Entry* entry = values.find(text);
      if (entry == nullptr) {
        const std::string name = excerpt(identifier(text));
        fail(node, fmt::format("parameter '${}' has no value; give it one with -D {}=... or a "
                               "<default> (defined: {})",
                               name, name, name_list(values.names(), "none")));
      }
      names.insert(entry->first);
      result += entry->second;
      if (result.size() > longest_value) {
        fail(node, fmt::format("a value with '${}' in it grows beyond {} bytes, which is the limit",
                               excerpt(entry->first), longest_value));
      }
      text.remove_prefix(entry->first.size());
    }
    result += text;
    replaced += result.size();
    if (replaced > most_replaced) {
      fail(node, fmt::format("the values with parameters in them have more than {} bytes together, "
                             "which is the limit",
                             most_replaced));
    }
    return result;
  };

  // Defaults first, so that a parameter may be used above the line that defines it.
  for_each_element(root(), stop, [&](pugi::xml_node node, int /*depth*/) {
    if (std::string_view(node.name()) != "default") return;
    const std::string name = node.attribute("name").value();
    if (name.empty()) fail(node, "<default> needs a name");
    if (name.size() > longest_name) {
      fail(node, fmt::format("the name of <default> has {} bytes, at most {} are possible",
                             name.size(), longest_name));
    }
    names.insert(name);
    const std::string_view value = node.attribute("value").value();
    if (values.contains(name)) return;
    values.add(name, value.find('$') == std::string_view::npos ? std::string(value)
                                                               : replace(node, value));
  });
  for_each_element(root(), stop, [&](pugi::xml_node node, int /*depth*/) {
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
                                     printable(path_.string()), excerpt(name),
                                     name_list(names, "none")));
  }
}

void XmlDocument::collect_ids(const std::stop_token& stop) {
  for_each_element(root(), stop, [&](pugi::xml_node node, int /*depth*/) {
    const std::string_view id = node.attribute("id").value();
    if (id.empty() || std::string_view(node.name()) == "ref") return;
    const auto [entry, is_new] = ids_.emplace(id, node);
    if (!is_new) {
      fail(node,
           fmt::format("id '{}' is already used in line {}", excerpt(id), line(entry->second)));
    }
  });
}

pugi::xml_node XmlDocument::target(pugi::xml_node reference) const {
  const std::string_view id = reference.attribute("id").value();
  const auto entry = ids_.find(id);
  if (entry == ids_.end()) {
    std::vector<std::string_view> known;
    for (const auto& [name, node] : ids_) known.push_back(name);
    fail(reference,
         fmt::format("nothing has the id '{}' (ids: {})", excerpt(id), name_list(known, "none")));
  }
  // What many references lead to is read many times.
  const auto children = entry->second.children();
  referred_ += 1 + std::size_t(std::distance(children.begin(), children.end()));
  if (referred_ > most_referred) {
    fail(reference, fmt::format("the references of this file lead to more than {} elements, each "
                                "counted as often as it is led to; that is the limit",
                                most_referred));
  }
  return entry->second;
}

}  // namespace quartet
