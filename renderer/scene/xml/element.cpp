#include "renderer/scene/xml/element.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "renderer/scene/xml/number.h"
#include "renderer/scene/xml/transform.h"

namespace quartet {

Element::Element(SceneBuilder& builder, pugi::xml_node node) : builder_(&builder), node_(node) {
  check_cancelled(builder.stop);
}

std::string Element::id() const {
  return excerpt(node_.attribute("id").value(), 1000);
}

std::string Element::title() const {
  const std::string tag = excerpt(node_.name());
  return type().empty() ? fmt::format("<{}>", tag) : fmt::format("{} '{}'", tag, excerpt(type()));
}

bool Element::has(std::string_view name) const {
  return std::any_of(node_.begin(), node_.end(),
                     [&](pugi::xml_node child) { return name == child.attribute("name").value(); });
}

pugi::xml_node Element::property(std::string_view name,
                                 std::initializer_list<std::string_view> tags) {
  pugi::xml_node found;
  for (pugi::xml_node child : node_.children()) {
    if (name != child.attribute("name").value()) continue;
    if (found) {
      builder_->warn(child,
                     fmt::format("{} of {} is given twice, the last one counts", name, title()));
    }
    found = child;
    used_.insert(child);
  }
  if (found && std::find(tags.begin(), tags.end(), found.name()) == tags.end()) {
    builder_->xml.fail(found, fmt::format("{} of {} is a <{}>, expected <{}>", name, title(),
                                          excerpt(found.name()), fmt::join(tags, "> or <")));
  }
  return found;
}

double Element::number(std::string_view name, double fallback) {
  const pugi::xml_node child = property(name, {"float", "integer"});
  if (!child) return fallback;
  const std::string_view value = child.attribute("value").value();
  const std::optional<double> number = parse_number(value);
  if (!number || std::abs(*number) > std::numeric_limits<float>::max()) {
    builder_->xml.fail(child, fmt::format("{} of {} is '{}', expected a finite number", name,
                                          title(), excerpt(value)));
  }
  return *number;
}

double Element::positive(std::string_view name, double fallback) {
  const double value = number(name, fallback);
  if (value <= 0.0) {
    builder_->xml.fail(property(name, {"float", "integer"}),
                       fmt::format("{} of {} is {}, must be above 0", name, title(), value));
  }
  return value;
}

int Element::integer(std::string_view name, int fallback) {
  const pugi::xml_node child = property(name, {"integer", "float"});
  if (!child) return fallback;
  const std::string_view value = child.attribute("value").value();
  const std::optional<double> number = parse_number(value);
  if (!number || *number != std::floor(*number) ||
      std::abs(*number) > std::numeric_limits<int>::max()) {
    builder_->xml.fail(
        child, fmt::format("{} of {} is '{}', expected a whole number from {} to {}", name, title(),
                           excerpt(value), -std::numeric_limits<int>::max(),
                           std::numeric_limits<int>::max()));
  }
  return int(*number);
}

bool Element::boolean(std::string_view name, bool fallback) {
  const pugi::xml_node child = property(name, {"boolean"});
  if (!child) return fallback;
  const std::string_view value = child.attribute("value").value();
  if (value != "true" && value != "false") {
    builder_->xml.fail(child, fmt::format("{} of {} is '{}', expected true or false", name, title(),
                                          excerpt(value)));
  }
  return value == "true";
}

std::string Element::text(std::string_view name, std::string_view fallback) {
  const pugi::xml_node child = property(name, {"string"});
  return child ? std::string(child.attribute("value").value()) : std::string(fallback);
}

glm::dvec3 Element::point(std::string_view name, const glm::dvec3& fallback) {
  const pugi::xml_node child = property(name, {"point", "vector"});
  return child ? read_vector(builder_->xml, child, glm::dvec3(0.0)) : fallback;
}

glm::dmat4 Element::transform(std::string_view name) {
  const pugi::xml_node child = property(name, {"transform"});
  return child ? read_transform(builder_->xml, child) : glm::dmat4(1.0);
}

std::vector<pugi::xml_node> Element::objects(std::string_view tag) {
  std::vector<pugi::xml_node> found;
  for (pugi::xml_node child : node_.children()) {
    if (child.type() != pugi::node_element) continue;
    const bool reference = std::string_view(child.name()) == "ref";
    const pugi::xml_node object = reference ? builder_->xml.target(child) : child;
    if (tag != object.name()) continue;
    used_.insert(child);
    found.push_back(object);
  }
  return found;
}

void Element::ignore(std::initializer_list<std::string_view> names) {
  for (pugi::xml_node child : node_.children()) {
    const std::string_view name = child.attribute("name").value();
    if (std::find(names.begin(), names.end(), name) != names.end()) used_.insert(child);
  }
}

void Element::warn_unused() {
  for (pugi::xml_node child : node_.children()) {
    if (child.type() != pugi::node_element || used_.contains(child)) continue;
    const std::string_view name = child.attribute("name").value();
    builder_->warn(
        child,
        name.empty()
            ? fmt::format("<{}> in {} is not known and left out", excerpt(child.name()), title())
            : fmt::format("property '{}' of {} is not known and left out", excerpt(name), title()));
  }
}

}  // namespace quartet
