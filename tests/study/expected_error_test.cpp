#include "renderer/study/stability/expected_error.h"

#include <gtest/gtest.h>

#include "renderer/scene/load_scene.h"
#include "renderer/scene/synthetic.h"
#include "renderer/trace/trace_scene.h"

namespace quartet {
namespace {

// One sample of a distribution with variance v around m is off by v / (m² + 0.01) in expectation,
// however many samples the pictures had. Over 24 × 24 pixels and 32 pictures: 3 %, five standard
// deviations are some 15 % of a distribution with as heavy a fourth moment as bernoulli's.
TEST(ExpectedErrors, AreTheVarianceOfASample) {
  const auto scene = std::make_shared<const TraceScene>(open_scene("synthetic:bernoulli"));
  RenderSettings settings = default_settings(scene->scene());
  settings.width = settings.height = 24;
  const Synthetic& row = find_synthetic("bernoulli");
  const RadianceImage truth(24, 24, glm::vec3(float(row.mean)));
  for (const std::uint32_t spp : {4u, 16u}) {
    int told = 0;
    const auto expected = expected_errors(scene, settings, truth, spp, 32, [&] {
      ++told;
      return true;
    });
    EXPECT_EQ(told, 32);
    double mean = 0.0;
    for (const glm::vec3& pixel : expected->pixels()) {
      EXPECT_EQ(pixel.x, pixel.z);
      mean += double(pixel.x) / double(expected->size());
    }
    const double right = row.variance / (row.mean * row.mean + 0.01);
    EXPECT_NEAR(mean, right, 0.15 * right) << spp;
  }
  EXPECT_FALSE(expected_errors(scene, settings, truth, 4, 32, [] { return false; }));
}

}  // namespace
}  // namespace quartet
