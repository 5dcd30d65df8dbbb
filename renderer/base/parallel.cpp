#include "renderer/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

namespace quartet {

void parallel_ranges(std::size_t count, std::size_t grain,
                     void (*body)(void* context, std::size_t begin, std::size_t end),
                     void* context) {
  // Whether numbers next to 0 count as 0 is as the caller has it. Else it is as an arena's first
  // caller had it, which may have been Embree, that builds scenes with such numbers taken for 0.
  tbb::task_group_context settings;
  settings.capture_fp_settings();
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [=](const tbb::blocked_range<std::size_t>& range) {
        body(context, range.begin(), range.end());
      },
      settings);
}

}  // namespace quartet
