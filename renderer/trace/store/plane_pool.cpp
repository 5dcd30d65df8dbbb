#include "renderer/trace/store/plane_pool.h"

#include <sys/mman.h>

#include <new>

namespace quartet {

template <class Plane>
Plane* PlanePool<Plane>::allocate() {
  if (!free_.empty()) {
    Plane* plane = free_.back();
    free_.pop_back();
    return plane;
  }
  if (uncut_ == 0) {
    void* memory = std::aligned_alloc(slab_bytes, slab_bytes);
    if (!memory) {
      throw std::bad_alloc();
    }
    madvise(memory, slab_bytes, MADV_HUGEPAGE);  // a wish; without it all works, slower
    slabs_.emplace_back(static_cast<Plane*>(memory));
    uncut_ = slab_planes;
  }
  return slabs_.back().get() + (slab_planes - uncut_--);
}

template class PlanePool<SamplePlane>;
template class PlanePool<MeanPlane>;

}  // namespace quartet
