#include "renderer/scene/xml/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "renderer/base/excerpt.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/xml/number.h"
#include "renderer/scene/xml/texture.h"

namespace quartet {
namespace {

/// IEC 61966-2-1.
float srgb_to_linear(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

std::optional<glm::vec3> parse_hex(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  unsigned code = 0;
  const auto [stop, error] = std::from_chars(text.data() + 1, text.data() + 7, code, 16);
  if (error != std::errc{} || stop != text.data() + 7) return std::nullopt;
  glm::vec3 color;
  for (int i = 0; i < 3; ++i)
    color[i] = srgb_to_linear(float(code >> (16 - 8 * i) & 255u) / 255.0f);
  return color;
}

glm::vec3 read_numbers(const XmlDocument& xml, pugi::xml_node node) {
  const std::string_view text = node.attribute("value").value();
  const auto parts = split(text);
  if (parts.size() == 1) {
    if (const std::optional<glm::vec3> color = parse_hex(parts[0])) return *color;
  }
  glm::vec3 color(0.0f);
  const bool counted = parts.size() == 1 || parts.size() == 3;
  for (std::size_t i = 0; counted && i < 3; ++i) {
    const std::optional<float> value = parse_float(parts[parts.size() == 1 ? 0 : i]);
    if (!value) {
      xml.fail(node,
               fmt::format("<{}> is '{}', expected finite numbers", node.name(), excerpt(text)));
    }
    color[int(i)] = *value;
  }
  if (!counted) {
    xml.fail(node, fmt::format("<{}> is '{}', expected 1 or 3 numbers or #rrggbb", node.name(),
                               excerpt(text)));
  }
  return color;
}

/// A spectrum by wavelength needs colour matching that an RGB renderer otherwise has no use for.
glm::vec3 read_spectrum(SceneBuilder& builder, pugi::xml_node node) {
  const std::string_view text = node.attribute("value").value();
  if (text.find(':') == std::string_view::npos && !node.attribute("filename")) {
    return read_numbers(builder.xml, node);
  }
  double sum = 0.0;
  const auto parts = split(text);
  for (std::string_view part : parts) {
    const std::size_t colon = part.find(':');
    const std::optional<double> value =
        colon == std::string_view::npos ? std::nullopt : parse_number(part.substr(colon + 1));
    if (!value) {
      builder.xml.fail(
          node, fmt::format("<spectrum> holds '{}', expected wavelength:value", excerpt(part)));
    }
    sum += *value;
  }
  if (parts.empty())
    builder.xml.fail(node, "<spectrum> from a file cannot be read, expected <rgb>");
  builder.warn(node, "a <spectrum> by wavelength becomes grey, the mean of its values");
  const float mean = float(sum / double(parts.size()));
  return {mean, mean, mean};
}

struct RangeRow {
  ColorRange range;
  double least;  // of the strongest channel, unless that is 0
  double most;
};

constexpr std::array ranges = {
    RangeRow{ColorRange::any, 0.0, std::numeric_limits<float>::max()},
    RangeRow{ColorRange::reflectance, 0.0, largest_reflectance},
    RangeRow{ColorRange::radiance, least_radiance, largest_radiance},
    RangeRow{ColorRange::intensity, least_intensity, largest_intensity},
    RangeRow{ColorRange::metal_index, 0.0, largest_metal_index},
    RangeRow{ColorRange::alpha, 0.0, largest_alpha},
};

void check_range(SceneBuilder& builder, pugi::xml_node node, std::string_view slot,
                 const glm::vec3& value, ColorRange range) {
  const std::string numbers = fmt::format("({}, {}, {})", value.x, value.y, value.z);
  // Also true for what is not a number.
  if (!glm::all(glm::greaterThanEqual(value, glm::vec3(0.0f)))) {
    builder.xml.fail(node, fmt::format("{} is negative {}", slot, numbers));
  }
  const auto& row = *std::find_if(ranges.begin(), ranges.end(),
                                  [&](const RangeRow& each) { return each.range == range; });
  const float strongest = std::max({value.x, value.y, value.z});
  if (strongest > float(row.most)) {
    builder.xml.fail(node,
                     fmt::format("{} is {}, at most {} is possible", slot, numbers, row.most));
  }
  if (strongest > 0.0f && strongest < float(row.least)) {
    builder.xml.fail(node,
                     fmt::format("{} is {}, expected 0 or, in the strongest channel, at least "
                                 "{}",
                                 slot, numbers, row.least));
  }
  if (range == ColorRange::reflectance && strongest > 1.0f) {
    builder.warn(node, fmt::format("{} is above 1 {}: it creates energy, and pictures may not "
                                   "converge",
                                   slot, numbers));
  }
}

}  // namespace

Color read_color(SceneBuilder& builder, Element& element, std::string_view name,
                 const glm::vec3& fallback, ColorRange range) {
  const pugi::xml_node node =
      element.property(name, {"rgb", "spectrum", "float", "texture", "ref"});
  if (!node) return {fallback};
  const std::string_view tag = node.name();
  const std::string slot = fmt::format("{} of {}", name, element.title());
  Color color;
  if (tag == "texture" || tag == "ref") {
    const pugi::xml_node object = tag == "ref" ? builder.xml.target(node) : node;
    if (std::string_view(object.name()) != "texture") {
      builder.xml.fail(node, fmt::format("{} refers to a <{}>, expected a <texture>", slot,
                                         excerpt(object.name())));
    }
    color = read_texture(builder, object);
  } else {
    color.value =
        tag == "spectrum" ? read_spectrum(builder, node) : read_numbers(builder.xml, node);
  }
  if (!color.is_textured()) {
    check_range(builder, node, slot, color.value, range);
  } else {
    const auto check_extremes = [&](const auto& kind) {
      for (const glm::vec3& value : kind.extremes()) check_range(builder, node, slot, value, range);
    };
    std::visit(check_extremes, builder.scene.textures[std::size_t(color.texture)]);
  }
  return color;
}

glm::vec3 read_plain_color(SceneBuilder& builder, Element& element, std::string_view name,
                           const glm::vec3& fallback, ColorRange range) {
  const Color color = read_color(builder, element, name, fallback, range);
  if (!color.is_textured()) return color.value;
  element.warn(fmt::format("the texture on {} of {} becomes the mean of its colours", name,
                           element.title()));
  return average_color(builder.scene.textures, color);
}

}  // namespace quartet
