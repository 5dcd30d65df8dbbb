#include "renderer/adaptive/memory_need.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <limits>

namespace quartet {

std::string memory_refusal(int width, int height, std::size_t lanes) {
  // A pixel of a lane (film with statistics, those of a replicated sampler too; error, counts,
  // plan) and of the store with a few samples.
  constexpr double lane_bytes = 250.0;
  constexpr double store_bytes = 150.0;
  constexpr double gib = 1024.0 * 1024.0 * 1024.0;
  const double pixels = double(width) * double(height);
  const double needed = pixels * (lane_bytes * double(lanes) + store_bytes);
  const double available = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
  if (needed <= available) {
    constexpr int most = std::numeric_limits<std::int32_t>::max();
    return pixels <= double(most)
               ? std::string()
               : fmt::format("{}x{} are more pixels than can be counted, {}", width, height, most);
  }
  return fmt::format(
      "{}x{} would take about {:.0f} GiB of memory, and this machine has {:.0f} GiB; choose a "
      "smaller size",
      width, height, needed / gib, available / gib);
}

}  // namespace quartet
