#include "renderer/scene/materials/rough_conductor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/excerpt.h"
#include "renderer/scene/materials/hashed_row.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element_writer.h"

namespace quartet {
namespace {

// Below this a GGX lobe is a mirror in single precision; Mitsuba clamps to the same value.
constexpr double smallest_alpha = 1e-4;

double read_alpha(SceneBuilder& builder, Element& element, std::string_view name, double fallback) {
  const glm::vec3 value =
      read_plain_color(builder, element, name, glm::vec3(float(fallback)), ColorRange::alpha);
  return value.x;
}

}  // namespace

std::string RoughConductor::text(const Textures& textures) const {
  return fmt::format("{}, GGX alpha {:.4g}", metal.text(textures), alpha);
}

void RoughConductor::add_to(Hasher& hasher) const {
  const auto& [of_metal, roughness] = *this;
  const auto& [reflectance, eta, k] = of_metal;
  hasher.add(HashedRow{.reflectance = reflectance, .eta = eta, .k = k, .alpha = roughness});
}

RoughConductor RoughConductor::read(SceneBuilder& builder, Element& element) {
  RoughConductor material{Metal::read(builder, element)};
  const std::string distribution = element.text("distribution", "beckmann");
  if (distribution != "ggx") {
    element.warn(
        fmt::format("distribution '{}' becomes ggx with the same alpha", excerpt(distribution)));
  }
  double alpha = read_alpha(builder, element, "alpha", 0.1);
  if (element.has("alpha_u") || element.has("alpha_v")) {
    const double alpha_u = read_alpha(builder, element, "alpha_u", alpha);
    const double alpha_v = read_alpha(builder, element, "alpha_v", alpha);
    if (alpha_u != alpha_v) {
      element.warn("different alpha_u and alpha_v become their geometric mean: the lobe is round");
    }
    alpha = std::sqrt(alpha_u * alpha_v);
  }
  material.alpha = float(std::max(alpha, smallest_alpha));
  element.ignore({"sample_visible"});
  return material;
}

void RoughConductor::write(ElementWriter& element) const {
  metal.write(element);
  element.text("distribution", "ggx");
  element.number("alpha", alpha);
}

}  // namespace quartet
