#include "renderer/scene/scene_hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string_view>

#include "renderer/base/hash_mix.h"
#include "renderer/scene/synthetic.h"

namespace quartet {

namespace {

/// Only to keep two scenes of one user apart.
class Hasher {
 public:
  void add(std::uint64_t word) { state_ = hash_mix((state_ ^ word) + golden_step); }
  void add(float value) { add(std::uint64_t(std::bit_cast<std::uint32_t>(value))); }
  void add(glm::vec2 v) { add_all(v.x, v.y); }
  void add(glm::vec3 v) { add_all(v.x, v.y, v.z); }
  void add(glm::uvec3 v) { add_all(std::uint64_t(v.x), std::uint64_t(v.y), std::uint64_t(v.z)); }
  void add(const glm::mat3& m) { add_all(m[0], m[1], m[2]); }
  void add(bool value) { add(std::uint64_t(value)); }
  void add(int value) { add(std::uint64_t(std::int64_t(value))); }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::uint64_t(values.size()));
    for (const T& value : values) {
      add(value);
    }
  }

  // Every field of each struct is named, so that one that is added does not compile until it was
  // decided whether it belongs to what is rendered.

  void add(const Color& color) {
    const auto& [value, texture] = color;
    add_all(value, texture);
  }
  void add(const Checkerboard& board) {
    const auto& [color0, color1, to_uv] = board;
    add_all(color0, color1, to_uv);
  }
  void add(const Material& material) {
    const auto& [kind, two_sided, reflectance, transmittance, eta, k, ior, alpha, id] = material;
    add_all(int(kind), two_sided, reflectance, transmittance, eta, k, ior, alpha);
  }
  void add(const Mesh& mesh) {
    const auto& [positions, normals, uvs, triangles, parallelogram] = mesh;
    add_all(positions, normals, uvs, triangles, parallelogram);
  }
  void add(const Sphere& sphere) {
    const auto& [center, radius, flip_normals, to_local] = sphere;
    add_all(center, radius, flip_normals, to_local);
  }
  void add(const Disk& disk) {
    const auto& [center, normal, axis_u, axis_v, radius] = disk;
    add_all(center, normal, axis_u, axis_v, radius);
  }
  void add(const Shape& shape) {
    const auto& [geometry, material, emits, radiance, id, line] = shape;
    add(int(geometry.index()));
    std::visit([this](const auto& kind) { add(kind); }, geometry);
    add_all(material, emits, radiance);
  }
  void add(const PointLight& light) {
    const auto& [position, intensity] = light;
    add_all(position, intensity);
  }
  void add(const Scene& scene) {
    const auto& [name, path, shapes, materials, textures, points, environment, camera, width,
                 height, max_depth, warnings] = scene;
    add_all(shapes, materials, textures, points, environment);
    if (const Synthetic* row = synthetic_of(scene)) {
      for (const char letter : row->id) {
        add(int(letter));
      }
    }
  }

  std::uint64_t state() const { return state_; }

 private:
  template <class... Parts>
  void add_all(const Parts&... parts) {
    (add(parts), ...);
  }

  std::uint64_t state_ = 0;
};

}  // namespace

std::string scene_hash(const Scene& scene) {
  Hasher hasher;
  hasher.add(scene);
  return fmt::format("{:016x}", hasher.state());
}

}  // namespace quartet
