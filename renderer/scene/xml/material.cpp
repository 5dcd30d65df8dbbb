#include "renderer/scene/xml/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "renderer/base/excerpt.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/xml/color.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/refractive_index.h"

namespace quartet {
namespace {

// Below this a GGX lobe is a mirror in single precision; Mitsuba clamps to the same value.
constexpr double smallest_alpha = 1e-4;

Material build_material(SceneBuilder& builder, pugi::xml_node node);

Material diffuse(SceneBuilder& builder, Element& element) {
  Material material;
  material.reflectance =
      read_color(builder, element, "reflectance", glm::vec3(0.5f), ColorRange::reflectance);
  return material;
}

void read_metal(SceneBuilder& builder, Element& element, Material& material) {
  const std::string name = element.text("material", "none");
  const auto table = named_conductors();
  const auto row = std::find_if(table.begin(), table.end(), [&](const NamedConductor& candidate) {
    return candidate.name == name;
  });
  if (row == table.end()) {
    builder.xml.fail(element.property("material", {"string"}),
                     fmt::format("no metal is named '{}' (known: {}); expected one of them, or eta "
                                 "and k",
                                 excerpt(name), names(table)));
  }
  if (name != "none" && (element.has("eta") || element.has("k"))) {
    element.fail(
        fmt::format("{} has both material and eta or k, expected one of them", element.title()));
  }
  material.eta = read_plain_color(builder, element, "eta", row->eta, ColorRange::metal_index);
  material.k = read_plain_color(builder, element, "k", row->k, ColorRange::metal_index);
  material.reflectance = read_color(builder, element, "specular_reflectance", glm::vec3(1.0f),
                                    ColorRange::reflectance);
}

Material conductor(SceneBuilder& builder, Element& element) {
  Material material;
  material.kind = MaterialKind::conductor;
  read_metal(builder, element, material);
  return material;
}

double read_alpha(SceneBuilder& builder, Element& element, std::string_view name, double fallback) {
  const glm::vec3 value =
      read_plain_color(builder, element, name, glm::vec3(float(fallback)), ColorRange::alpha);
  return value.x;
}

Material rough_conductor(SceneBuilder& builder, Element& element) {
  Material material;
  material.kind = MaterialKind::rough_conductor;
  read_metal(builder, element, material);
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

void check_ior(const Element& element, std::string_view name, double ior) {
  if (!(ior >= least_ior && ior <= largest_ior)) {
    element.fail(fmt::format("{} of {} is {}, must be from {} to {}", name, element.title(), ior,
                             least_ior, largest_ior));
  }
}

double read_ior(SceneBuilder& builder, Element& element, std::string_view name,
                std::string_view fallback) {
  const pugi::xml_node node = element.property(name, {"float", "string"});
  if (node && std::string_view(node.name()) == "float") {
    const double ior = element.positive(name, 1.0);
    check_ior(element, name, ior);
    return ior;
  }
  std::string wanted = node ? node.attribute("value").value() : std::string(fallback);
  std::transform(wanted.begin(), wanted.end(), wanted.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  const auto table = named_dielectrics();
  const auto row = std::find_if(table.begin(), table.end(), [&](const NamedDielectric& candidate) {
    return candidate.name == wanted;
  });
  if (row == table.end()) {
    builder.xml.fail(node, fmt::format("{} is '{}', expected a number or one of {}", name,
                                       excerpt(wanted), names(table)));
  }
  return row->ior;
}

Material dielectric(SceneBuilder& builder, Element& element) {
  Material material;
  material.kind = MaterialKind::dielectric;
  const double ior =
      read_ior(builder, element, "int_ior", "bk7") / read_ior(builder, element, "ext_ior", "air");
  check_ior(element, "int_ior over ext_ior", ior);
  material.ior = float(ior);
  material.reflectance = read_color(builder, element, "specular_reflectance", glm::vec3(1.0f),
                                    ColorRange::reflectance);
  material.transmittance = read_color(builder, element, "specular_transmittance", glm::vec3(1.0f),
                                      ColorRange::reflectance);
  return material;
}

Material two_sided(SceneBuilder& builder, Element& element) {
  const auto nested = element.objects("bsdf");
  if (nested.empty()) element.fail("bsdf 'twosided' holds no bsdf");
  if (nested.size() > 1) {
    element.warn("bsdf 'twosided' with two bsdfs: the first one is used for both sides");
  }
  Material material = build_material(builder, nested[0]);
  if (material.kind == MaterialKind::dielectric) {
    element.fail("bsdf 'twosided' around a dielectric, expected one that lets no light through");
  }
  material.two_sided = true;
  return material;
}

struct MaterialType {
  std::string_view name;
  Material (*read)(SceneBuilder&, Element&);
};

constexpr std::array material_types = {
    MaterialType{"diffuse", diffuse},       MaterialType{"conductor", conductor},
    MaterialType{"dielectric", dielectric}, MaterialType{"roughconductor", rough_conductor},
    MaterialType{"twosided", two_sided},
};

Material build_material(SceneBuilder& builder, pugi::xml_node node) {
  const OpenElement open(builder, node);
  Element element(builder, node);
  const auto* const type =
      std::find_if(material_types.begin(), material_types.end(),
                   [&](const MaterialType& candidate) { return candidate.name == element.type(); });
  Material material;
  if (type == material_types.end()) {
    element.warn(fmt::format("{} is not known and becomes diffuse 0.5", element.title()));
  } else {
    material = type->read(builder, element);
    element.warn_unused();
  }
  if (!element.id().empty()) material.id = element.id();
  return material;
}

}  // namespace

int read_material(SceneBuilder& builder, pugi::xml_node node) {
  const auto known = builder.materials.find(node);
  if (known != builder.materials.end()) return known->second;
  builder.scene.materials.push_back(build_material(builder, node));
  return builder.materials[node] = int(builder.scene.materials.size()) - 1;
}

int default_material(SceneBuilder& builder) {
  if (builder.default_material < 0) {
    builder.scene.materials.emplace_back();
    builder.default_material = int(builder.scene.materials.size()) - 1;
  }
  return builder.default_material;
}

}  // namespace quartet
