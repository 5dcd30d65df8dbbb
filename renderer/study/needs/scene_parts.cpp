#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "renderer/study/needs/part_rows.h"

namespace quartet {
namespace {

std::vector<Simplification> lights_of(const Model& whole) {
  const Scene& scene = whole.scene;
  std::vector<Simplification> found;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (scene.shapes[i].emits) {
      found.push_back({PartId::light, fmt::format("{} dark", shape_label(scene, i)),
                       [i](Model& model) { model.scene.shapes[i].emits = false; }});
    }
  }
  for (std::size_t i = 0; i < scene.delta_lights.size(); ++i) {
    found.push_back({PartId::light, fmt::format("point light {} dark", i + 1), [i](Model& model) {
                       std::visit([](auto& kind) { kind.intensity = glm::vec3(0.0f); },
                                  model.scene.delta_lights[i]);
                     }});
  }
  if (shines(scene.environment)) {
    found.push_back({PartId::light, "surroundings dark",
                     [](Model& model) { model.scene.environment = Environment(); }});
  }
  // A scene without any is none.
  if (found.size() < 2) {
    found.clear();
  }
  return found;
}

/// Every slot of colour of a material, for change. Whoever adds a kind is asked for its slots here.
struct ColorSlots {
  std::vector<Color*> operator()(Diffuse& kind) const { return {&kind.reflectance}; }
  std::vector<Color*> operator()(Conductor& kind) const { return {&kind.metal.reflectance}; }
  std::vector<Color*> operator()(RoughConductor& kind) const { return {&kind.metal.reflectance}; }
  std::vector<Color*> operator()(Dielectric& kind) const {
    return {&kind.reflectance, &kind.transmittance};
  }
};

std::vector<Color*> color_slots(Scene& scene) {
  std::vector<Color*> slots;
  for (Material& material : scene.materials) {
    for (Color* slot : std::visit(ColorSlots(), material.kind)) {
      slots.push_back(slot);
    }
  }
  for (Shape& shape : scene.shapes) {
    if (shape.emits) {
      slots.push_back(&shape.radiance);
    }
  }
  return slots;
}

/// Where a texture is seen first; empty if it is not.
std::string place_of_texture(const Scene& scene, int texture) {
  const auto shows = [&](const Color& color) { return color.texture == texture; };
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (std::visit([&](const auto& kind) { return std::ranges::any_of(kind.colors(), shows); },
                   scene.materials[i].kind)) {
      return material_label(scene, i);
    }
  }
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (scene.shapes[i].emits && shows(scene.shapes[i].radiance)) {
      return shape_label(scene, i);
    }
  }
  return {};
}

std::vector<Simplification> textures_of(const Model& whole) {
  std::vector<Simplification> found;
  for (int i = 0; i < int(whole.scene.textures.size()); ++i) {
    if (const std::string place = place_of_texture(whole.scene, i); !place.empty()) {
      found.push_back(
          {PartId::texture, fmt::format("texture of {} → its mean", place), [i](Model& model) {
             for (Color* slot : color_slots(model.scene)) {
               if (slot->texture == i) {
                 *slot = {average_color(model.scene.textures, *slot)};
               }
             }
           }});
    }
  }
  return found;
}

/// The mean over the directions of a diffuse illumination of what a Fresnel formula of the cosine
/// reflects.
template <class Fresnel>
auto hemispherical(const Fresnel& fresnel) {
  constexpr int steps = 256;
  decltype(fresnel(1.0f)) sum(0.0f);
  for (int i = 0; i < steps; ++i) {
    const float cosine = (float(i) + 0.5f) / float(steps);
    sum += fresnel(cosine) * (2.0f * cosine / float(steps));
  }
  return sum;
}

Diffuse diffuse_of(const Textures& textures, const Metal& metal) {
  const glm::vec3 share =
      hemispherical([&](float cosine) { return fresnel_conductor(cosine, metal.eta, metal.k); });
  return {{average_color(textures, metal.reflectance) * share}};
}

/// A diffuse surface that sends as much on as a material does, all of it to the side that it came
/// from. Nothing for one that is diffuse already.
struct AsDiffuse {
  const Textures& textures;

  std::optional<Diffuse> operator()(const Diffuse& /*kind*/) const { return std::nullopt; }
  std::optional<Diffuse> operator()(const Conductor& kind) const {
    return diffuse_of(textures, kind.metal);
  }
  std::optional<Diffuse> operator()(const RoughConductor& kind) const {
    return diffuse_of(textures, kind.metal);
  }
  std::optional<Diffuse> operator()(const Dielectric& kind) const {
    const float share = hemispherical([&](float cosine) {
      float refracted = 0.0f;
      return fresnel_dielectric(cosine, kind.ior, refracted);
    });
    return Diffuse{{share * average_color(textures, kind.reflectance) +
                    (1.0f - share) * average_color(textures, kind.transmittance)}};
  }
};

std::vector<Simplification> gloss_of(const Model& whole) {
  const Scene& scene = whole.scene;
  std::vector<Simplification> found;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    const auto diffuse = std::visit(AsDiffuse{scene.textures}, material.kind);
    if (diffuse) {
      // Glass has no back.
      const bool two_sided = material.two_sided || transmits(material);
      found.push_back(
          {PartId::gloss,
           fmt::format("{} {} → diffuse", material_label(scene, i), material_name(material)),
           [i, diffuse = *diffuse, two_sided](Model& model) {
             model.scene.materials[i].kind = diffuse;
             model.scene.materials[i].two_sided = two_sided;
           }});
    }
  }
  return found;
}

std::vector<Simplification> normals_of(const Model& whole) {
  std::vector<Simplification> found;
  for (std::size_t i = 0; i < whole.scene.shapes.size(); ++i) {
    const Mesh* mesh = std::get_if<Mesh>(&whole.scene.shapes[i].geometry);
    if (mesh && !mesh->normals.empty()) {
      found.push_back(
          {PartId::normals, fmt::format("{} smooth → flat", shape_label(whole.scene, i)),
           [i](Model& model) { std::get<Mesh>(model.scene.shapes[i].geometry).normals.clear(); }});
    }
  }
  return found;
}

}  // namespace

constexpr Part light_part{
    .key = PartId::light,
    .id = "lights",
    .label = "light",
    .description = "each shape that shines, point light, and surroundings: dark",
    .same_mean = false,
    .can_be_left = true,
    .exclusive = false,
    .of = lights_of};

constexpr Part texture_part{.key = PartId::texture,
                            .id = "textures",
                            .label = "texture",
                            .description = "each its mean colour",
                            .same_mean = false,
                            .can_be_left = true,
                            .exclusive = false,
                            .of = textures_of};

constexpr Part gloss_part{.key = PartId::gloss,
                          .id = "gloss",
                          .label = "gloss",
                          .description = "each metal and glass diffuse, sending on as much light",
                          .same_mean = false,
                          .can_be_left = true,
                          .exclusive = false,
                          .of = gloss_of};

constexpr Part normals_part{.key = PartId::normals,
                            .id = "normals",
                            .label = "smooth normals",
                            .description = "each smooth mesh flat",
                            .same_mean = false,
                            .can_be_left = true,
                            .exclusive = false,
                            .of = normals_of};

}  // namespace quartet
