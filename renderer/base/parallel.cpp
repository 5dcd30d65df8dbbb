#include "renderer/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace quartet {

void parallel_ranges(std::size_t count, std::size_t grain,
                     void (*body)(void* context, std::size_t begin, std::size_t end),
                     void* context) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [=](const tbb::blocked_range<std::size_t>& range) {
                      body(context, range.begin(), range.end());
                    });
}

}  // namespace quartet
