#include <gtest/gtest.h>

#include <array>

#include "renderer/adaptive/film/film.h"
#include "renderer/adaptive/lab.h"

namespace quartet {
namespace {

constexpr FilmStatistics clamp_at_four{.variance = true, .clamp = 4.0f};

float clamped_mean(std::initializer_list<float> samples) {
  Film film(1, 1, clamp_at_four);
  for (const float sample : samples) {
    // One by one, as passes bring them.
    film.add(0, std::array{glm::vec3(sample, 0.5f, 1.0f)});
  }
  EXPECT_EQ(film.mean(1)[0], 0.5f) << "each channel by itself";
  return film.mean(0)[0];
}

TEST(Clamp, CutsWhatIsAboveIt) {
  EXPECT_EQ(clamped_mean({1.0f, 3.0f}), 2.0f);
  EXPECT_EQ(clamped_mean({1.0f, 1.0f, 100.0f}), 2.0f);
  EXPECT_EQ(clamped_mean({4.0f, 2.0f}), 3.0f) << "4 is not above 4";
}

TEST(Clamp, CutsAFirstSampleOnceTheSecondShowsNoLight) {
  EXPECT_EQ(clamped_mean({100.0f}), 100.0f);
  EXPECT_EQ(clamped_mean({100.0f, 2.0f}), 3.0f);
  EXPECT_EQ(clamped_mean({100.0f, 2.0f, 9.0f, 9.0f}), (4.0f + 2.0f + 4.0f + 4.0f) / 4.0f);
}

TEST(Clamp, LeavesAPixelThatSeesALight) {
  EXPECT_EQ(clamped_mean({20.0f, 20.0f}), 20.0f);
  EXPECT_EQ(clamped_mean({20.0f, 20.0f, 2.0f, 30.0f}), 18.0f);
}

TEST(Clamp, VarianceIsOfWhatEntered) {
  Film film(1, 1, clamp_at_four);
  film.add(0, std::array{glm::vec3(100.0f), glm::vec3(2.0f), glm::vec3(9.0f)});
  // 4, 2 and 4: squared deviations of 8/3, over 2 · 3.
  EXPECT_NEAR(film.variance_of_mean(0).x, 8.0 / 3.0 / 6.0, 1e-12);
}

TEST(Clamp, AnotherRunBeginsAnew) {
  Film film(1, 1, clamp_at_four);
  film.add(0, std::array{glm::vec3(20.0f), glm::vec3(20.0f)});
  film.restart(clamp_at_four);
  film.add(0, std::array{glm::vec3(1.0f), glm::vec3(9.0f)});
  EXPECT_EQ(film.mean(0)[0], 2.5f);
}

TEST(Clamp, UniformClampedShowsItsSamplesCut) {
  const SampleSource source = [](int x, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3(x == 0 && (first + i) % 4 == 3 ? 41.0f : 1.0f);
    }
  };
  for (const SampleMode mode : {SampleMode::reuse, SampleMode::unbiased}) {
    LaneSettings settings = default_settings(EstimatorId::uniform_clamp);
    settings.mode = mode;
    LabOptions options;
    options.pilot_source = source;
    Lab lab(source, 2, 1, std::span(&settings, 1), options);
    for (int pass = 0; pass < 8; ++pass) {
      ASSERT_TRUE(lab.run_pass());
    }
    EXPECT_EQ(lab.lanes()[0].film().mean(0)[0], 14.0f / 8.0f);
    EXPECT_EQ(lab.lanes()[0].film().mean(0)[1], 1.0f);
  }
}

}  // namespace
}  // namespace quartet
