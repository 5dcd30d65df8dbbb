#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace quartet {

/// Pixels a side of a tile, whose values lie together.
inline constexpr std::size_t plane_side = 8;
inline constexpr std::size_t plane_values = plane_side * plane_side;

/// One sample of each pixel of a tile.
struct SamplePlane {
  glm::vec3 radiance[plane_values];  ///< linear
  std::uint16_t rays[plane_values];  ///< that it took
};

/// The first samples of a pixel, so many of them.
struct FirstSamples {
  glm::vec3 mean;      ///< linear radiance
  std::uint32_t rays;  ///< that they took
};

/// The same number of first samples of each pixel of a tile.
struct MeanPlane {
  FirstSamples pixels[plane_values];
};

/// Memory for planes. What is given back is used again.
template <class Plane>
class PlanePool {
 public:
  Plane* allocate();
  void release(Plane* plane) { free_.push_back(plane); }
  /// Of the planes in use; what has been released waits to be used again.
  std::size_t bytes() const {
    return (slabs_.size() * slab_planes - uncut_ - free_.size()) * sizeof(Plane);
  }

 private:
  struct Free {
    void operator()(Plane* slab) const { std::free(slab); }
  };
  // Huge pages: a replay touches every plane, and would else wait for the page tables.
  static constexpr std::size_t slab_bytes = std::size_t(2) << 20;
  static constexpr std::size_t slab_planes = slab_bytes / sizeof(Plane);

  std::vector<std::unique_ptr<Plane[], Free>> slabs_;
  std::size_t uncut_ = 0;  // planes of the last slab that were never handed out
  std::vector<Plane*> free_;
};

extern template class PlanePool<SamplePlane>;
extern template class PlanePool<MeanPlane>;

}  // namespace quartet
