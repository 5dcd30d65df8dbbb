#include "renderer/session/find_rejected.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace quartet {
namespace {

TEST(RejectedSample, TheFirstIsFoundWhereverItIs) {
  for (const std::uint32_t bad : {0u, 15u, 16u, 37u}) {
    const SampleSource source = [bad](int x, int y, std::uint32_t first,
                                      std::span<glm::vec3> radiance) {
      EXPECT_EQ(x, 3);
      EXPECT_EQ(y, 5);
      for (std::uint32_t i = 0; i < radiance.size(); ++i) {
        radiance[i] = glm::vec3(0.5f);
        if (first + i == bad || first + i == bad + 2) {
          radiance[i].y = std::numeric_limits<float>::quiet_NaN();
        }
      }
    };
    EXPECT_EQ(first_rejected(source, 3, 5, 64), bad);
    EXPECT_EQ(first_rejected(source, 3, 5, bad + 1), bad);
    EXPECT_EQ(first_rejected(source, 3, 5, bad), std::nullopt) << "that one was not taken";
  }
}

TEST(RejectedSample, StopEndsTheSearch) {
  std::stop_source stop;
  std::uint32_t made = 0;
  const SampleSource source = [&](int, int, std::uint32_t, std::span<glm::vec3> radiance) {
    std::ranges::fill(radiance, glm::vec3(0.5f));
    made += std::uint32_t(radiance.size());
    stop.request_stop();
  };
  EXPECT_EQ(first_rejected(source, 0, 0, 1'000'000, stop.get_token()), std::nullopt);
  EXPECT_LT(made, 1000u);
}

}  // namespace
}  // namespace quartet
