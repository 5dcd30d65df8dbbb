#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "renderer/base/lower_case.h"
#include "renderer/files/picture_formats.h"

namespace quartet {
namespace {

/// Channels of a part whose names are the same up to the last dot.
struct ChannelGroup {
  std::size_t part = 0;
  std::string name;    ///< of the layer
  std::string prefix;  ///< of its channels, with the dot
  std::vector<std::string> components;

  std::optional<std::string> component(std::string_view letter, std::string_view word) const;
  std::vector<std::string> color() const;
  std::vector<std::string> luminance() const;
};

/// Some write r, red or Red for R.
std::optional<std::string> ChannelGroup::component(std::string_view letter,
                                                   std::string_view word) const {
  for (const std::string& own : components) {
    if (const std::string lower = lower_case(own); lower == letter || lower == word) {
      return prefix + own;
    }
  }
  return std::nullopt;
}

/// Its R, G and B; nothing if it is no colour.
std::vector<std::string> ChannelGroup::color() const {
  const auto r = component("r", "red");
  const auto g = component("g", "green");
  const auto b = component("b", "blue");
  return r && g && b ? std::vector{*r, *g, *b} : std::vector<std::string>();
}

/// Its Y, if that is not a coordinate, nor luminance with chroma beside it.
std::vector<std::string> ChannelGroup::luminance() const {
  const bool other = component("x", "x") || component("z", "z") || component("ry", "ry") ||
                     component("by", "by") || component("r", "red");
  const auto y = component("y", "y");
  return y && !other ? std::vector{*y} : std::vector<std::string>();
}

/// A part is named where there are several; its channels may repeat its name, or not.
std::string layer_name(const std::string& part, std::string_view prefix) {
  std::string group(prefix.substr(0, prefix.empty() ? 0 : prefix.size() - 1));
  if (part.empty() || group == part || group.starts_with(part + ".")) {
    return group;
  }
  return group.empty() ? part : part + "." + group;
}

std::vector<ChannelGroup> groups_of(std::span<const ExrPartHeader> parts) {
  std::vector<ChannelGroup> groups;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::size_t first = groups.size();
    for (const std::string& channel : parts[part].channels) {
      const std::string prefix = channel.substr(0, channel.rfind('.') + 1);  // npos + 1 is 0
      auto group = std::find_if(groups.begin() + std::ptrdiff_t(first), groups.end(),
                                [&](const ChannelGroup& g) { return g.prefix == prefix; });
      if (group == groups.end()) {
        groups.push_back({part, layer_name(parts[part].name, prefix), prefix, {}});
        group = groups.end() - 1;
      }
      group->components.push_back(channel.substr(prefix.size()));
    }
  }
  return groups;
}

/// In the order of R, G, B and A, for people: a file has them in that of the alphabet.
std::vector<std::string> people_order(std::vector<std::string> names) {
  std::ranges::stable_sort(names, {}, [](const std::string& name) {
    constexpr std::string_view order = "rgba";
    return name.empty() ? std::string_view::npos : order.find(lower_case(name)[0]);
  });
  return names;
}

/// "ViewLayer.Combined (R G B A), ViewLayer.Depth (Z)".
std::string list_of(std::span<const ChannelGroup> groups) {
  std::string text;
  for (const ChannelGroup& group : groups) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ",
                        group.name.empty() ? "unnamed" : group.name,
                        fmt::join(people_order(group.components), " "));
  }
  return text.empty() ? "none" : text;
}

ExrLayer layer_of(const ChannelGroup& group) {
  std::vector<std::string> color = group.color();
  return {group.part, group.name, color.empty() ? group.luminance() : std::move(color)};
}

ExrLayer named_layer(std::span<const ChannelGroup> groups, const PictureOptions& options) {
  std::vector<const ChannelGroup*> found;
  for (const ChannelGroup& group : groups) {
    if (group.name == options.layer) {
      found.push_back(&group);
    }
  }
  for (const ChannelGroup& group : groups) {
    if (found.empty() || found.front()->name != options.layer) {
      if (group.name.ends_with("." + options.layer)) {
        found.push_back(&group);
      }
    }
  }
  if (found.size() != 1) {
    throw std::runtime_error(fmt::format("{} '{}' names {} of its layers; it has: {}",
                                         options.layer_option, options.layer,
                                         found.empty() ? "none" : "several", list_of(groups)));
  }
  ExrLayer layer = layer_of(*found.front());
  if (layer.channels.empty()) {
    throw std::runtime_error(fmt::format(
        "{} '{}' names a layer without R, G and B, and without luminance Y; its layers: {}",
        options.layer_option, options.layer, list_of(groups)));
  }
  return layer;
}

}  // namespace

ExrLayer choose_exr_layer(std::span<const ExrPartHeader> parts, const PictureOptions& options) {
  const std::vector<ChannelGroup> groups = groups_of(parts);
  if (!options.layer.empty()) {
    return named_layer(groups, options);
  }
  using Kind = std::vector<std::string> (ChannelGroup::*)() const;
  for (const Kind kind : {&ChannelGroup::color, &ChannelGroup::luminance}) {
    std::vector<const ChannelGroup*> found;
    std::vector<const ChannelGroup*> unnamed;
    for (const ChannelGroup& group : groups) {
      if (!(group.*kind)().empty()) {
        found.push_back(&group);
        if (group.name.empty()) {
          unnamed.push_back(&group);
        }
      }
    }
    if (unnamed.size() == 1) {
      return layer_of(*unnamed.front());
    }
    if (found.size() == 1) {
      return layer_of(*found.front());
    }
    if (!found.empty()) {
      throw std::runtime_error(
          fmt::format("{} of its layers could be the picture; choose with {}: {}", found.size(),
                      options.layer_option, list_of(groups)));
    }
  }
  throw std::runtime_error(
      fmt::format("it has no layer with R, G and B, nor with luminance Y alone; its layers: {}",
                  list_of(groups)));
}

}  // namespace quartet
