#pragma once

#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/base/math/hash_mix.h"
#include "renderer/scene/color.h"

namespace quartet {

/// 64 bits, only to keep two scenes of one user apart.
///
/// What is hashed says so in add_to(Hasher&), and names every field of its struct there, so that
/// one that is added does not compile until it was decided whether it belongs to what is rendered.
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
  void add(const Color& color) {
    const auto& [value, texture] = color;
    add_all(value, texture);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::uint64_t(values.size()));
    for (const T& value : values) {
      add(value);
    }
  }
  template <class T>
  requires requires(const T& part, Hasher& hasher) { part.add_to(hasher); }
  void add(const T& part) { part.add_to(*this); }
  template <class... Parts>
  void add_all(const Parts&... parts) {
    (add(parts), ...);
  }

  std::uint64_t state() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace quartet
