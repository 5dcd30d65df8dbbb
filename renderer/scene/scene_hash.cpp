#include "renderer/scene/scene_hash.h"

#include <fmt/format.h>

#include <cstdint>
#include <variant>

#include "renderer/scene/hasher.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

/// Textures and lights were of one kind each when the first scenes were hashed: that kind has no
/// number, others do.
template <class... Kinds>
void add_kind(Hasher& hasher, const std::variant<Kinds...>& family) {
  if (family.index() > 0) {
    hasher.add(int(family.index()));
  }
  std::visit([&](const auto& kind) { hasher.add(kind); }, family);
}

template <class Family>
void add_kinds(Hasher& hasher, const std::vector<Family>& families) {
  hasher.add(std::uint64_t(families.size()));
  for (const Family& family : families) {
    add_kind(hasher, family);
  }
}

void add(Hasher& hasher, const Scene& scene) {
  const auto& [name, path, shapes, materials, textures, delta_lights, environment, camera, width,
               height, max_depth, warnings] = scene;
  hasher.add_all(shapes, materials);
  add_kinds(hasher, textures);
  add_kinds(hasher, delta_lights);
  add_kind(hasher, environment);
  if (const Synthetic* row = synthetic_of(scene)) {
    for (const char letter : row->id) {
      hasher.add(int(letter));
    }
  }
}

}  // namespace

std::string scene_hash(const Scene& scene) {
  Hasher hasher;
  add(hasher, scene);
  return fmt::format("{:016x}", hasher.state());
}

}  // namespace quartet
