#include "renderer/study/stability/failure_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "renderer/adaptive/lab.h"
#include "renderer/scene/load_scene.h"
#include "tests/trace/statistics.h"

namespace quartet::test {
namespace {

TEST(FailureCases, EachCanBeOpenedAndSaysWhatToLookAt) {
  std::set<std::string_view> ids;
  for (const FailureCase& row : failure_cases()) {
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_NO_THROW(open_scene(row.scene)) << row.id;
    EXPECT_GT(row.watch.size(), 40u) << row.id;
    EXPECT_EQ(row.watch.back(), '.') << row.id;
    EXPECT_TRUE(0.0 <= row.region.left && row.region.left < row.region.right &&
                row.region.right <= 1.0 && 0.0 <= row.region.top &&
                row.region.top < row.region.bottom && row.region.bottom <= 1.0)
        << row.id;
    EXPECT_GE(row.zoom, 1.0f) << row.id;
  }
}

TEST(FailureCases, EverySceneOfTheFolderIsOne) {
  for (const std::string& name : builtin_scenes()) {
    if (name.starts_with("failures/")) {
      EXPECT_TRUE(std::ranges::any_of(failure_cases(), [&](const FailureCase& row) {
        return row.scene == name;
      })) << name;
    }
  }
}

TEST(FailureCases, ARegionIsNeverEmpty) {
  EXPECT_EQ(pixels_of({}, 96, 64).pixels(), 96 * 64);
  EXPECT_EQ(pixels_of({0.0, 0.0, 1.0, 0.001}, 96, 64).pixels(), 96);
  EXPECT_EQ(pixels_of({0.99, 0.99, 1.0, 1.0}, 2, 2).pixels(), 1);
  const PixelRegion half = pixels_of({0.5, 0.25, 1.0, 0.75}, 100, 100);
  EXPECT_EQ(half.left, 50);
  EXPECT_EQ(half.right, 100);
  EXPECT_EQ(half.top, 25);
  EXPECT_EQ(half.bottom, 75);
}

/// Samples 0 … count − 1 of a pixel.
std::vector<glm::vec3> samples_of(const std::string& name, double x, double y, std::size_t count) {
  const auto scene = std::make_shared<const TraceScene>(open_scene(name));
  const RenderSettings settings = default_settings(scene->scene());
  std::vector<glm::vec3> samples(count);
  sample_source(scene, settings)(int(x * settings.width), int(y * settings.height), 0, samples);
  return samples;
}

double share(const std::vector<glm::vec3>& samples, float above) {
  return double(std::ranges::count_if(samples,
                                      [&](const glm::vec3& sample) { return sample.x > above; })) /
         double(samples.size());
}

// What each scene is built to do. Shares of 16 384 samples have a standard deviation under 0.004,
// and samples are stratified.
TEST(FailureScenes, DoWhatTheyAreFor) {
  for (const auto& [x, y] : {std::pair{0.1, 0.2}, {0.5, 0.5}, {0.9, 0.7}}) {
    const auto two_valued = samples_of("failures/two-valued", x, y, 16384);
    EXPECT_NEAR(share(two_valued, 0.5f), 0.5, 0.02);
    for (const glm::vec3& sample : two_valued) {
      EXPECT_TRUE(sample.x == 0.0f || sample.x == 1.0f);
    }
  }
  const double found = share(samples_of("failures/rare-light", 0.5, 0.5, 16384), 5.0f);
  EXPECT_GT(found, 1.0 / 70.0);
  EXPECT_LT(found, 1.0 / 40.0);

  const auto wall = samples_of("failures/black-channel", 0.5, 0.5, 16384);
  const auto blue = std::ranges::count_if(wall, [](const glm::vec3& s) { return s.z > 0.0f; });
  EXPECT_LT(double(blue) / double(wall.size()), 0.1);
  EXPECT_GT(blue, 20);

  const auto furnace = samples_of("failures/grey-furnace", 0.3, 0.6, 16384);
  double mean = 0.0;
  for (const glm::vec3& sample : furnace) {
    mean += double(sample.x) / double(furnace.size());
  }
  EXPECT_NEAR(mean, 0.5, 0.01);
}

TEST(FailureScenes, WiresAreAThirdOfAPixelWideAndEightSamplesMissSome) {
  const FailureCase& wires = find_failure_case("wires");
  const auto scene = std::make_shared<const TraceScene>(open_scene(wires.scene));
  const RenderSettings settings = default_settings(scene->scene());
  const SampleSource source = sample_source(scene, settings);
  const PixelRegion region = pixels_of(wires.region, settings.width, settings.height);
  std::vector<glm::vec3> samples(64);
  double dark = 0.0;
  double missed = 0.0;
  for (int y = region.top; y < region.bottom; ++y) {
    for (int x = region.left; x < region.right; ++x) {
      source(x, y, 0, samples);
      const double covered = 1.0 - share(samples, 0.5f);
      dark += covered;
      samples.resize(8);
      missed += share(samples, 0.5f) == 1.0 ? 1.0 : 0.0;
      samples.resize(64);
      EXPECT_GT(covered, 0.2) << "no pixel without a wire";
    }
  }
  // They are a pixel apart.
  EXPECT_NEAR(dark / region.pixels(), 1.0 / 3.0, 0.02);
  EXPECT_GT(missed, 0.0);
  EXPECT_LT(missed, 0.05 * region.pixels());
}

}  // namespace
}  // namespace quartet::test
