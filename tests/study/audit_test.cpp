#include "renderer/study/stability/audit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr int audited_width = 64;
constexpr int audited_height = 48;

SampleSource source_of(std::string_view id, std::uint64_t seed) {
  return [row = &find_synthetic(id), seed](int x, int y, std::uint32_t first,
                                           std::span<glm::vec3> radiance) {
    draw_synthetic(*row, seed, x, y, first, radiance);
  };
}

// 3 072 lots at 1 in 4: standard deviation 24; false alarms under 1e-6.
TEST(Audit, LooksAtTheShareOfPixelsThatWasAskedFor) {
  const Audit audit(source_of("log-normal", 1), audited_width, audited_height, 0.25, 2, 9);
  EXPECT_NEAR(double(audit.pixels().size()), 768.0, 120.0);
  const Audit other(source_of("log-normal", 1), audited_width, audited_height, 0.25, 2, 10);
  std::size_t common = 0;
  for (const Audit::Pixel& a : audit.pixels()) {
    for (const Audit::Pixel& b : other.pixels()) {
      common += a.pixel == b.pixel ? 1 : 0;
    }
  }
  EXPECT_NEAR(double(common), 192.0, 70.0);  // independent of each other
}

TEST(Audit, MeansAndTheirVarianceAreThoseOfTheSource) {
  const Synthetic& row = find_synthetic("bernoulli");
  constexpr std::uint32_t samples = 400;
  const Audit audit(source_of("bernoulli", 3), audited_width, audited_height, 1.0, samples, 0);
  ASSERT_EQ(audit.pixels().size(), std::size_t(audited_width) * audited_height);
  double mean = 0.0;
  double variance = 0.0;
  for (const Audit::Pixel& pixel : audit.pixels()) {
    mean += pixel.mean.y / double(audit.pixels().size());
    variance += pixel.variance_of_mean.y / double(audit.pixels().size());
  }
  // Over a million samples; five standard deviations.
  EXPECT_NEAR(mean, row.mean, 5.0 * std::sqrt(row.variance / (samples * 3072.0)));
  EXPECT_NEAR(variance * samples / row.variance, 1.0, 0.02);
}

TEST(Audit, RejectsWhatAFilmRejects) {
  const Audit audit(source_of("non-finite", 3), 8, 8, 1.0, 500, 0);
  for (const Audit::Pixel& pixel : audit.pixels()) {
    EXPECT_NEAR(pixel.mean.x, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / 480.0));
    EXPECT_TRUE(std::isfinite(pixel.variance_of_mean.x));
  }
}

// Two samples, 1 and 3: mean 2, and 1 is the variance of that mean. A picture of x is off by
// ((x − 2)² − 1) / (4 + 0.01).
TEST(Audit, TakesItsOwnNoiseOffTheError) {
  const SampleSource hidden = [](int, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3((first + i) % 2 == 0 ? 1.0f : 3.0f);
    }
  };
  const Audit audit(hidden, 4, 1, 1.0, 2, 0);
  ASSERT_EQ(audit.pixels().size(), 4u);
  EXPECT_DOUBLE_EQ(audit.pixels()[0].mean.y, 2.0);
  EXPECT_DOUBLE_EQ(audit.pixels()[0].variance_of_mean.y, 1.0);
  const std::vector<PixelState> states{PixelState::done, PixelState::done, PixelState::refining,
                                       PixelState::done};
  const std::vector<float> mean{5.0f, 3.0f, 5.0f, 2.0f};
  const std::array<std::span<const float>, 3> means{mean, mean, mean};
  const double error = 8.0 / 4.01;
  EXPECT_EQ(audit.check(states, means, error - 1e-9).done, 3.0);
  EXPECT_EQ(audit.check(states, means, error - 1e-9).wrong, 1.0);
  EXPECT_EQ(audit.check(states, means, error + 1e-9).wrong, 0.0);
  EXPECT_EQ(audit.check(states, means, 1e-9).wrong, 1.0) << "3 is off by no more than the noise";
}

// Every second pixel of the picture is wrong by a fifth of the truth, the others are right; every
// third is not done. The audit's noise, 0.0003 in squared relative error, is far from the target.
TEST(Audit, FindsWhatIsDoneAndWrong) {
  const Audit audit(source_of("negative", 3), audited_width, audited_height, 0.5, 4000, 5);
  std::vector<float> mean(std::size_t(audited_width) * audited_height, 0.5f);
  std::vector<PixelState> states(mean.size(), PixelState::done);
  double done = 0.0;
  double wrong = 0.0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    mean[i] *= i % 2 == 0 ? 1.2f : 1.0f;
    states[i] = i % 3 == 0 ? PixelState::at_maximum : PixelState::done;
  }
  for (const Audit::Pixel& pixel : audit.pixels()) {
    done += pixel.pixel % 3 == 0 ? 0.0 : 1.0;
    wrong += pixel.pixel % 3 != 0 && pixel.pixel % 2 == 0 ? 1.0 : 0.0;
  }
  const Audit::Finding finding = audit.check(states, {mean, mean, mean}, 0.02);
  EXPECT_EQ(finding.done, done);
  EXPECT_EQ(finding.wrong, wrong);
  EXPECT_EQ(audit.check(states, {mean, mean, mean}, 0.1).wrong, 0.0);
}

}  // namespace
}  // namespace quartet
