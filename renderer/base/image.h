#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace quartet {

/// A picture with pixels of type T in rows from the top left. Linear radiance (glm::vec3), one
/// number a pixel (float), or display pixels (Rgba8).
template <class T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T value = T{})
      : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height), value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return pixels_.size(); }
  bool empty() const { return pixels_.empty(); }

  T& at(int x, int y) { return pixels_[index(x, y)]; }
  const T& at(int x, int y) const { return pixels_[index(x, y)]; }
  std::span<T> pixels() { return pixels_; }
  std::span<const T> pixels() const { return pixels_; }

  bool operator==(const Image&) const = default;

 private:
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

/// A display pixel: sRGB-encoded, alpha straight.
struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  bool operator==(const Rgba8&) const = default;
};

using RadianceImage = Image<glm::vec3>;  ///< linear RGB, Rec. 709 primaries
using ScalarImage = Image<float>;
using DisplayImage = Image<Rgba8>;

/// Luminance of linear RGB with Rec. 709 primaries.
template <class T>
constexpr T luminance(T r, T g, T b) {
  return T(0.2126) * r + T(0.7152) * g + T(0.0722) * b;
}
inline float luminance(glm::vec3 c) {
  return luminance(c.r, c.g, c.b);
}

}  // namespace quartet
