#pragma once

#include <cstddef>
#include <cstdlib>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace quartet {

/// Memory for planes: one RGB value for each pixel of a tile. What is given back is used again.
class PlanePool {
 public:
  static constexpr std::size_t tile_size = 8;  ///< pixels a side
  static constexpr std::size_t plane_values = tile_size * tile_size;

  glm::vec3* allocate();
  void release(glm::vec3* plane) { free_.push_back(plane); }
  /// Of the planes in use; what has been released waits to be used again.
  std::size_t bytes() const {
    return (slabs_.size() * slab_planes - uncut_ - free_.size()) * plane_values * sizeof(glm::vec3);
  }

 private:
  struct Free {
    void operator()(glm::vec3* slab) const { std::free(slab); }
  };
  // Huge pages: a replay touches every plane, and would else wait for the page tables.
  static constexpr std::size_t slab_bytes = std::size_t(2) << 20;
  static constexpr std::size_t slab_planes = slab_bytes / (plane_values * sizeof(glm::vec3));

  std::vector<std::unique_ptr<glm::vec3[], Free>> slabs_;
  std::size_t uncut_ = 0;  // planes of the last slab that were never handed out
  std::vector<glm::vec3*> free_;
};

}  // namespace quartet
