#include "renderer/trace/plane_pool.h"

#include <sys/mman.h>

#include <new>

namespace quartet {

glm::vec3* PlanePool::allocate() {
  if (!free_.empty()) {
    glm::vec3* plane = free_.back();
    free_.pop_back();
    return plane;
  }
  if (uncut_ == 0) {
    void* memory = std::aligned_alloc(slab_bytes, slab_bytes);
    if (!memory) {
      throw std::bad_alloc();
    }
    madvise(memory, slab_bytes, MADV_HUGEPAGE);  // a wish; without it all works, slower
    slabs_.emplace_back(static_cast<glm::vec3*>(memory));
    uncut_ = slab_planes;
  }
  return slabs_.back().get() + plane_values * (slab_planes - uncut_--);
}

}  // namespace quartet
