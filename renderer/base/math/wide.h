#pragma once

#include <immintrin.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <type_traits>

namespace quartet {

// Eight values at a time, one a lane (of a processor's vector, not of the lab). Operators and
// comparisons are the compiler's own and work lane by lane; each lane gets to the bit what a single
// float would. So a formula that is written once, as a template over `float` and `Float8`, serves
// one path and eight alike.

inline constexpr int simd_lanes = 8;

using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
using Word8 = std::uint32_t __attribute__((vector_size(32)));
/// What comparisons give: all bits set in lanes where they hold, none elsewhere.
using Mask8 = Int8;

inline unsigned lane_bits(Mask8 mask) {
  return unsigned(_mm256_movemask_ps(__m256(mask)));
}
inline bool any(Mask8 mask) {
  return lane_bits(mask) != 0;
}
inline bool any(bool condition) {
  return condition;
}

/// Calls body(lane) for each lane of the mask.
template <class Body>
void for_each_lane(Mask8 mask, const Body& body) {
  for (unsigned bits = lane_bits(mask); bits != 0; bits &= bits - 1) {
    body(std::countr_zero(bits));
  }
}

inline Float8 splat(float value) {
  return value - Float8{};
}

using std::abs;
using std::copysign;
using std::sqrt;
inline Float8 abs(Float8 x) {
  return Float8(Int8(x) & 0x7fffffff);
}
inline Float8 copysign(float magnitude, Float8 sign) {
  return Float8(Int8(splat(magnitude)) | (Int8(sign) & Int8(splat(-0.0f))));
}
inline Float8 sqrt(Float8 x) {
  return Float8(_mm256_sqrt_ps(__m256(x)));
}
template <class F>
F min_of(F a, F b) {
  return b < a ? b : a;
}
template <class F>
F max_of(F a, F b) {
  return a < b ? b : a;
}

/// Eight vectors, and the part of glm that is wanted of them.
struct Vec8 {
  Float8 x, y, z;

  Vec8& operator+=(const Vec8& b) { return x += b.x, y += b.y, z += b.z, *this; }
  Vec8& operator*=(const Vec8& b) { return x *= b.x, y *= b.y, z *= b.z, *this; }
  Vec8& operator/=(Float8 s) { return x /= s, y /= s, z /= s, *this; }
};
inline Vec8 operator-(const Vec8& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec8 operator+(const Vec8& a, const Vec8& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec8 operator-(const Vec8& a, const Vec8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec8 operator*(const Vec8& a, const Vec8& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Vec8 operator*(const Vec8& a, Float8 s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec8 operator*(Float8 s, const Vec8& a) {
  return {s * a.x, s * a.y, s * a.z};
}
// With a vector that is the same in all lanes.
inline Vec8 operator+(glm::vec3 a, const Vec8& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec8 operator*(Float8 s, glm::vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Vec8 operator*(float s, const Vec8& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Float8 dot(const Vec8& a, const Vec8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec8 normalize(const Vec8& a) {
  return a * (1.0f / sqrt(dot(a, a)));
}
inline Mask8 is_zero(const Vec8& a) {
  return (a.x == 0.0f) & (a.y == 0.0f) & (a.z == 0.0f);
}
inline Vec8 splat(glm::vec3 v) {
  return {splat(v.x), splat(v.y), splat(v.z)};
}
inline Vec8 select(Mask8 mask, const Vec8& a, const Vec8& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}
inline glm::vec3 lane_of(const Vec8& v, int lane) {
  return {v.x[lane], v.y[lane], v.z[lane]};
}
inline void set_lane(Vec8& v, int lane, glm::vec3 value) {
  v.x[lane] = value.x;
  v.y[lane] = value.y;
  v.z[lane] = value.z;
}

struct Vec2x8 {
  Float8 x, y;
};

/// The vectors that go with a scalar.
template <class F>
struct VectorsOf;
template <>
struct VectorsOf<float> {
  using Vec2 = glm::vec2;
  using Vec3 = glm::vec3;
};
template <>
struct VectorsOf<Float8> {
  using Vec2 = Vec2x8;
  using Vec3 = Vec8;
};
template <class F>
using Vec2 = typename VectorsOf<F>::Vec2;
template <class F>
using Vec3 = typename VectorsOf<F>::Vec3;

/// Eight structs into eight values a member, which are to be taken in the order of the members. A
/// struct holds sixteen floats, alone or as vectors, and nothing else.
class Columns {
 public:
  template <class Row>
  [[gnu::always_inline]] explicit Columns(const Row* const (&rows)[simd_lanes]) {
    static_assert(sizeof(Row) == sizeof(columns_) / simd_lanes);
    static_assert(std::is_standard_layout_v<Row> && std::is_trivially_copyable_v<Row>);
    transpose(rows, 0);
    transpose(rows, simd_lanes);
  }

  Float8 number() { return columns_[taken_++]; }
  Vec8 vector() {
    taken_ += 3;
    return {columns_[taken_ - 3], columns_[taken_ - 2], columns_[taken_ - 1]};
  }

 private:
  /// Eight floats of each row, from number `first` on.
  template <class Row>
  [[gnu::always_inline]] void transpose(const Row* const (&rows)[simd_lanes], int first) {
    __m256 a[simd_lanes];
    __m256 b[simd_lanes];
    for (int i = 0; i < simd_lanes; ++i) {
      a[i] = _mm256_loadu_ps(reinterpret_cast<const float*>(rows[i]) + first);
    }
    for (int i = 0; i < simd_lanes; i += 2) {
      b[i] = _mm256_unpacklo_ps(a[i], a[i + 1]);
      b[i + 1] = _mm256_unpackhi_ps(a[i], a[i + 1]);
    }
    for (int i = 0; i < simd_lanes; i += 4) {
      for (int k = 0; k < 2; ++k) {
        a[i + 2 * k] = _mm256_shuffle_ps(b[i + k], b[i + k + 2], 0x44);
        a[i + 2 * k + 1] = _mm256_shuffle_ps(b[i + k], b[i + k + 2], 0xee);
      }
    }
    for (int i = 0; i < 4; ++i) {
      columns_[first + i] = Float8(_mm256_permute2f128_ps(a[i], a[i + 4], 0x20));
      columns_[first + i + 4] = Float8(_mm256_permute2f128_ps(a[i], a[i + 4], 0x31));
    }
  }

  Float8 columns_[2 * simd_lanes];
  int taken_ = 0;
};

}  // namespace quartet
