#include "renderer/scene/xml/material.h"

#include <fmt/format.h>

#include <optional>

#include "renderer/scene/xml/read_kind.h"

namespace quartet {
namespace {

Material build_material(SceneBuilder& builder, pugi::xml_node node);

Material two_sided(SceneBuilder& builder, Element& element) {
  const auto nested = element.objects("bsdf");
  if (nested.empty()) element.fail("bsdf 'twosided' holds no bsdf");
  if (nested.size() > 1) {
    element.warn("bsdf 'twosided' with two bsdfs: the first one is used for both sides");
  }
  Material material = build_material(builder, nested[0]);
  if (transmits(material)) {
    element.fail(fmt::format("bsdf 'twosided' around a {}, expected one that lets no light through",
                             material_name(material)));
  }
  material.two_sided = true;
  return material;
}

Material build_material(SceneBuilder& builder, pugi::xml_node node) {
  const OpenElement open(builder, node);
  Element element(builder, node);
  Material material;
  if (element.type() == "twosided") {
    material = two_sided(builder, element);
    element.warn_unused();
  } else if (std::optional<MaterialKind> kind = read_kind<MaterialKind>(builder, element)) {
    material.kind = *kind;
    element.warn_unused();
  } else {
    element.warn(fmt::format("{} is not known and becomes diffuse 0.5", element.title()));
    material.kind = Diffuse{};
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
    builder.scene.materials.emplace_back().kind = Diffuse{};
    builder.default_material = int(builder.scene.materials.size()) - 1;
  }
  return builder.default_material;
}

}  // namespace quartet
