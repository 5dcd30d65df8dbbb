#include "renderer/scene/xml/transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/base/excerpt.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/xml/number.h"

namespace quartet {
namespace {

std::vector<double> numbers(const XmlDocument& xml, pugi::xml_node node, const char* attribute) {
  const std::string_view text = node.attribute(attribute).value();
  std::vector<double> values;
  for (std::string_view part : split(text)) {
    const std::optional<double> value = parse_number(part);
    if (!value || std::abs(*value) > largest_operand) {
      xml.fail(node,
               fmt::format("{} of <{}> is '{}', expected finite numbers from {} to {}", attribute,
                           node.name(), excerpt(text), -largest_operand, largest_operand));
    }
    values.push_back(*value);
  }
  return values;
}

glm::dvec3 three_numbers(const XmlDocument& xml, pugi::xml_node node, const char* attribute) {
  const std::vector<double> values = numbers(xml, node, attribute);
  if (values.size() != 3) {
    xml.fail(node, fmt::format("{} of <{}> holds {} numbers, expected 3", attribute, node.name(),
                               values.size()));
  }
  return {values[0], values[1], values[2]};
}

glm::dmat4 translate(const XmlDocument& xml, pugi::xml_node node) {
  return glm::translate(glm::dmat4(1.0), read_vector(xml, node, glm::dvec3(0.0)));
}

glm::dmat4 scale(const XmlDocument& xml, pugi::xml_node node) {
  return glm::scale(glm::dmat4(1.0), read_vector(xml, node, glm::dvec3(1.0)));
}

glm::dmat4 rotate(const XmlDocument& xml, pugi::xml_node node) {
  const glm::dvec3 axis = read_vector(xml, node, glm::dvec3(0.0));
  if (glm::length(axis) == 0.0) xml.fail(node, "<rotate> has no axis, expected e.g. y=\"1\"");
  const std::vector<double> angle = numbers(xml, node, "angle");
  if (angle.size() != 1) xml.fail(node, "<rotate> needs one angle, in degrees");
  return glm::rotate(glm::dmat4(1.0), glm::radians(angle[0]), glm::normalize(axis));
}

/// Mitsuba's camera convention: +z looks at the target and +x points to the left.
glm::dmat4 lookat(const XmlDocument& xml, pugi::xml_node node) {
  const glm::dvec3 origin = three_numbers(xml, node, "origin");
  const glm::dvec3 view = three_numbers(xml, node, "target") - origin;
  if (glm::length(view) == 0.0) xml.fail(node, "<lookat> has its target at its origin");
  const glm::dvec3 z = glm::normalize(view);
  const glm::dvec3 up = node.attribute("up")  ? three_numbers(xml, node, "up")
                        : std::abs(z.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0)
                                              : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 x = glm::cross(up, z);
  if (glm::length(x) <= 1e-9 * glm::length(up)) {
    xml.fail(node, "<lookat> has its up vector along the view direction (or zero)");
  }
  const glm::dvec3 left = glm::normalize(x);
  return {glm::dvec4(left, 0.0), glm::dvec4(glm::cross(z, left), 0.0), glm::dvec4(z, 0.0),
          glm::dvec4(origin, 1.0)};
}

/// Row by row, 4 × 4, or 3 × 3 for the upper left part (which is also the form of a uv transform).
glm::dmat4 matrix(const XmlDocument& xml, pugi::xml_node node) {
  const std::vector<double> values = numbers(xml, node, "value");
  if (values.size() != 16 && values.size() != 9) {
    xml.fail(node, fmt::format("<matrix> holds {} numbers, expected 16 or 9", values.size()));
  }
  const std::size_t size = values.size() == 16 ? 4 : 3;
  glm::dmat4 result(1.0);
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) {
      result[int(column)][int(row)] = values[row * size + column];
    }
  }
  return result;
}

struct Operation {
  std::string_view name;
  glm::dmat4 (*read)(const XmlDocument&, pugi::xml_node);
};

constexpr std::array operations = {
    Operation{"translate", translate}, Operation{"scale", scale},   Operation{"rotate", rotate},
    Operation{"lookat", lookat},       Operation{"matrix", matrix},
};

}  // namespace

glm::dvec3 read_vector(const XmlDocument& xml, pugi::xml_node node, const glm::dvec3& missing) {
  constexpr std::array axes = {"x", "y", "z"};
  if (node.attribute("value")) {
    for (const char* axis : axes) {
      if (node.attribute(axis)) {
        xml.fail(node,
                 fmt::format("<{}> has both value and {}, expected one form", node.name(), axis));
      }
    }
    const std::vector<double> values = numbers(xml, node, "value");
    if (values.size() == 1) return glm::dvec3(values[0]);
    return three_numbers(xml, node, "value");
  }
  glm::dvec3 result = missing;
  for (int i = 0; i < 3; ++i) {
    if (!node.attribute(axes[std::size_t(i)])) continue;
    const std::vector<double> value = numbers(xml, node, axes[std::size_t(i)]);
    if (value.size() != 1) {
      xml.fail(node,
               fmt::format("{} of <{}> is '{}', expected one number", axes[std::size_t(i)],
                           node.name(), excerpt(node.attribute(axes[std::size_t(i)]).value())));
    }
    result[i] = value[0];
  }
  return result;
}

glm::dmat4 read_transform(const XmlDocument& xml, pugi::xml_node node) {
  glm::dmat4 result(1.0);
  for (pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    const auto* const operation =
        std::find_if(operations.begin(), operations.end(),
                     [&](const Operation& candidate) { return candidate.name == child.name(); });
    if (operation == operations.end()) {
      xml.fail(child, fmt::format("<{}> is no transform, expected translate, scale, rotate, lookat "
                                  "or matrix",
                                  excerpt(child.name())));
    }
    result = operation->read(xml, child) * result;
  }
  const glm::dmat3 linear(result);
  const double size = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  const double determinant = std::abs(glm::determinant(linear));
  if (!std::isfinite(determinant) || determinant <= 1e-12 * size) {
    xml.fail(node, fmt::format("transform '{}' cannot be inverted (a scale of 0, or too flat)",
                               excerpt(node.attribute("name").value())));
  }
  if (result[0][3] != 0.0 || result[1][3] != 0.0 || result[2][3] != 0.0 || result[3][3] != 1.0) {
    xml.fail(node, fmt::format("transform '{}' is not affine: its last row must be 0 0 0 1",
                               excerpt(node.attribute("name").value())));
  }
  return result;
}

}  // namespace quartet
