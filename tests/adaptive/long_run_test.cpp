#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "renderer/adaptive/lab.h"

#if defined(__SANITIZE_ADDRESS__)
// Of sanitizer/allocator_interface.h, which GCC 12 does not install.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#endif

namespace quartet {
namespace {

/// Of this process, in bytes. AddressSanitizer keeps freed memory back on purpose: there, what is
/// allocated.
std::size_t memory_in_use() {
#if defined(__SANITIZE_ADDRESS__)
  return __sanitizer_get_current_allocated_bytes();
#else
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  file >> total >> resident;
  return resident * std::size_t(sysconf(_SC_PAGESIZE));
#endif
}

SampleSource steady_noise(std::uint32_t seed) {
  return [seed](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      std::uint32_t bits =
          (std::uint32_t(x + 4 * y) + seed) * 0x9e3779b9u + std::uint32_t(first + i);
      bits = (bits ^ (bits >> 16)) * 0x21f0aaadu;
      radiance[i] = glm::vec3(float(bits >> 8) * 0x1p-24f);
    }
  };
}

TEST(LongRun, MemoryStaysWithinTheBudgetOverAHundredThousandPasses) {
  constexpr std::size_t mib = std::size_t(1) << 20;
  LaneSettings reused = default_settings(EstimatorId::uniform);
  LaneSettings unbiased = default_settings(EstimatorId::kl);
  unbiased.mode = SampleMode::unbiased;
  reused.max_spp = unbiased.max_spp = 1u << 31;
  LabOptions options;
  options.threads = 1;
  options.memory = 4 * mib;
  options.pilot_source = steady_noise(1000);
  const LaneSettings lane_settings[] = {reused, unbiased};
  Lab lab(steady_noise(0), 4, 4, lane_settings, options);
  std::size_t settled = 0;
  for (std::uint32_t pass = 1; pass <= 100'000; ++pass) {
    ASSERT_TRUE(lab.run_pass());
    ASSERT_LE(lab.stored_bytes(), options.memory) << pass;
    if (pass == 20'000) {
      settled = memory_in_use();
    }
  }
  // The stores take their memory in slabs of 2 MiB, and the allocator has its own ways.
  EXPECT_LT(memory_in_use(), settled + 4 * mib);
  EXPECT_TRUE(lab.partial());
  for (const Lane& lane : lab.lanes()) {
    EXPECT_EQ(lane.pass(), 100'000u);
    EXPECT_LE(lane.history().size(), PassHistory::most_records);
    EXPECT_EQ(lane.history().back().rays, 0u) << "nothing was traced";
    for (const std::uint32_t taken : lane.taken()) {
      EXPECT_GE(taken, 100'000u);
    }
    for (const float mean : lane.film().mean(1)) {
      EXPECT_NEAR(mean, 0.5f, 0.01f);
    }
  }
}

}  // namespace
}  // namespace quartet
