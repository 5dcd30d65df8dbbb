#include "renderer/study/needs/parts.h"

#include <fmt/format.h>

#include "renderer/base/table.h"
#include "renderer/study/needs/part_rows.h"

namespace quartet {
namespace {

const Part* row_of_part(PartId key) {
  switch (key) {
    case PartId::depth:
      return &depth_part;
    case PartId::next_event:
      return &next_event_part;
    case PartId::roulette:
      return &roulette_part;
    case PartId::light:
      return &light_part;
    case PartId::texture:
      return &texture_part;
    case PartId::gloss:
      return &gloss_part;
    case PartId::lens:
      return &lens_part;
    case PartId::normals:
      return &normals_part;
  }
  return nullptr;
}

}  // namespace

std::span<const Part> parts() {
  static const std::vector<Part> table = table_of(row_of_part);
  return table;
}

const Part& part(PartId key) {
  return row_of(parts(), key);
}

const Part& find_part(std::string_view id) {
  return find_row(parts(), id, "part");
}

Model simplified(const Model& whole, std::span<const Simplification> simplifications) {
  Model model = whole;
  for (const Simplification& simplification : simplifications) {
    simplification.apply(model);
  }
  // A light without extent that is dark is none; the loader leaves it out, too.
  std::erase_if(model.scene.delta_lights, [](const DeltaLight& light) {
    return !std::visit([](const auto& kind) { return kind.shines(); }, light);
  });
  return model;
}

std::string shape_label(const Scene& scene, std::size_t shape) {
  const Shape& row = scene.shapes[shape];
  return row.id.empty() ? fmt::format("{} {}", shape_name(row), shape + 1)
                        : fmt::format("'{}'", row.id);
}

std::string material_label(const Scene& scene, std::size_t material) {
  const Material& row = scene.materials[material];
  if (!row.id.empty()) {
    return fmt::format("'{}'", row.id);
  }
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (scene.shapes[i].material == int(material)) {
      return shape_label(scene, i);
    }
  }
  return fmt::format("material {}", material + 1);
}

}  // namespace quartet
