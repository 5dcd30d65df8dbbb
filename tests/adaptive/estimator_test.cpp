#include "renderer/adaptive/estimators/estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/policy.h"
#include "tests/adaptive/estimator_cases.h"
#include "tests/adaptive/golden_windows.h"

// Each test walks the table of estimators, so that a new row is tested unasked.

namespace quartet {
namespace {

bool looks_at_neighbours(const Estimator& row) {
  return row.key == EstimatorId::contrast || row.key == EstimatorId::kl ||
         row.key == EstimatorId::chi2 || row.key == EstimatorId::hellinger;
}

/// For each row with an error.
void each_row(auto&& test) {
  for (const Estimator& row : estimators()) {
    if (row.estimate) {
      SCOPED_TRACE(row.id);
      test(row);
    }
  }
}

class Noise {
 public:
  explicit Noise(std::uint32_t seed, float spread = 1.0f) : random_(seed), spread_(spread) {}
  glm::vec3 operator()(std::size_t, std::size_t) { return {draw(), draw(), draw()}; }

 private:
  float draw() { return std::exp(spread_ * normal_(random_)); }

  std::mt19937 random_;
  float spread_;
  std::normal_distribution<float> normal_;
};

TEST(Estimators, AgreeWithBruteForce) {
  each_row([](const Estimator& row) {
    // 3 is the first number of samples with one in class A.
    for (const std::size_t count : {3u, 4u, 5u, 8u, 16u, 17u, 64u, 200u}) {
      for (const float spread : {0.03f, 1.0f, 4.0f}) {
        const SampledPicture picture(7, 5, count, Noise(std::uint32_t(count), spread));
        const BruteForce brute(picture);
        const std::vector<float> errors = picture.errors(row);
        for (std::size_t i = 0; i < errors.size(); ++i) {
          const std::size_t pixel = i % picture.samples.size();
          const double expected = brute.error(row.key, pixel, int(i / picture.samples.size()));
          // Means are rounded to single precision, and differences of means inherit that.
          const glm::dvec3 mean = mean_of(picture.samples[pixel]);
          const double rounding = 0x1p-23 * (mean.x + mean.y + mean.z + 1.0);
          ASSERT_NEAR(errors[i], expected, 2e-5 * expected + rounding)
              << count << " samples, spread " << spread;
        }
      }
    }
  });
}

TEST(Estimators, ConstantSamplesHaveNoError) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-30.0f, 30.0f);
  const auto value = [&] { return std::pow(10.0f, exponent(random)); };
  for (int i = 0; i < 100; ++i) {
    const glm::vec3 color(value(), value(), value());
    for (const std::size_t count : {3u, 8u, 21u}) {
      SampledPicture picture(5, 4, count, [&](std::size_t, std::size_t) { return color; });
      picture.truth.assign(20, color);
      each_row([&](const Estimator& row) {
        for (const float error : picture.errors(row)) {
          ASSERT_EQ(error, 0.0f) << color.x << ", " << color.y << ", " << color.z;
        }
      });
    }
  }
}

TEST(Estimators, BlackPixelsHaveNoError) {
  SampledPicture picture(5, 4, 8, [](std::size_t, std::size_t) { return glm::vec3(0.0f); });
  picture.truth.assign(20, glm::vec3(0.0f));
  each_row([&](const Estimator& row) {
    EXPECT_EQ(std::ranges::count(picture.errors(row), 0.0f), 20 * row.channels);
  });
}

TEST(Estimators, FiniteForEveryFiniteInput) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-30.0f, 30.0f);
  std::bernoulli_distribution black(0.3);
  const auto value = [&] { return black(random) ? 0.0f : std::pow(10.0f, exponent(random)); };
  for (int i = 0; i < 200; ++i) {
    const SampledPicture picture(6, 3, 3 + std::size_t(i) % 20, [&](std::size_t, std::size_t) {
      return glm::vec3(value(), value(), value());
    });
    each_row([&](const Estimator& row) {
      for (const float error : picture.errors(row)) {
        ASSERT_TRUE(std::isfinite(error) && error >= 0.0f) << error;
      }
    });
  }
}

TEST(Estimators, TheBrightestPixelsAreJudged) {
  // A pixel of the largest radiance among black ones, one of black among the largest, and noise of
  // that size: sums of it leave the range of float.
  constexpr float most = std::numeric_limits<float>::max();
  const auto bright = [](auto is_bright) {
    return SampledPicture(7, 3, 4, [&](std::size_t pixel, std::size_t i) {
      return glm::vec3(is_bright(pixel, i) ? most : 0.0f);
    });
  };
  for (const SampledPicture& picture :
       {bright([](std::size_t pixel, std::size_t) { return pixel == 10; }),
        bright([](std::size_t pixel, std::size_t) { return pixel != 10; }),
        bright([](std::size_t pixel, std::size_t i) { return (pixel + i / 2) % 2 == 0; })}) {
    each_row([&](const Estimator& row) {
      for (const float error : picture.errors(row)) {
        ASSERT_TRUE(std::isfinite(error) && error >= 0.0f) << error;
      }
    });
  }
  const SampledPicture alone = bright([](std::size_t pixel, std::size_t) { return pixel == 10; });
  for (const EstimatorId id : {EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2,
                               EstimatorId::hellinger, EstimatorId::oracle}) {
    EXPECT_GT(alone.errors(estimator(id))[10], estimator(id).default_thresholds[0])
        << estimator(id).id;
  }
}

TEST(Estimators, TooFewSamplesAreNotJudged) {
  each_row([](const Estimator& row) {
    for (const std::size_t count : {0u, 1u}) {
      // Equal and black samples: what would look done.
      const SampledPicture picture(3, 2, count,
                                   [](std::size_t, std::size_t) { return glm::vec3(0.0f); });
      const std::vector<float> errors = picture.errors(row);
      if (looks_at_neighbours(row)) {
        EXPECT_EQ(std::ranges::count(errors, 0.0f), std::ptrdiff_t(errors.size()));
      } else if (row.key != EstimatorId::oracle || count == 0) {
        EXPECT_EQ(std::ranges::count(errors, std::numeric_limits<float>::infinity()), 6);
      }
      Plan plan;
      LaneSettings settings = default_settings(row.key);
      settings.policy.kind = PolicyId::batch;
      const std::vector<std::uint32_t> taken(6, std::uint32_t(count));
      plan_next(settings, {3, 2, errors, taken, 1}, plan);
      EXPECT_EQ(plan.not_done, looks_at_neighbours(row) ? 0u : 6u);
    }
  });
}

TEST(Estimators, TheOrderOfWhatIsLookedAtDoesNotMatter) {
  each_row([](const Estimator& row) {
    if (row.needs.half != SampleHalf::none) {
      return;  // which half a sample is in is a matter of order
    }
    std::mt19937 random(3);
    SampledPicture picture(3, 3, 12, Noise(4));
    picture.truth.assign(9, glm::vec3(1.5f));
    const std::vector<float> before = picture.errors(row);
    // The window of the middle pixel holds all nine; other estimators look at a pixel alone.
    for (auto& samples : picture.samples) {
      std::ranges::shuffle(samples, random);
    }
    if (looks_at_neighbours(row)) {
      std::ranges::shuffle(picture.samples, random);
    }
    const std::vector<float> after = picture.errors(row);
    for (int c = 0; c < row.channels; ++c) {
      const std::size_t middle = std::size_t(9 * c + 4);
      EXPECT_NEAR(after[middle], before[middle], 2e-6f * before[middle]) << c;
    }
  });
}

/// The power of the exposure that an error follows.
double power_of_scale(EstimatorId id) {
  switch (id) {
    case EstimatorId::uniform:
    case EstimatorId::uniform_clamp:
    case EstimatorId::contrast:
    case EstimatorId::confidence:
      return 0.0;
    case EstimatorId::half_buffer:
      return 0.5;
    case EstimatorId::kl:
    case EstimatorId::chi2:
    case EstimatorId::hellinger:
    case EstimatorId::rigau_kl:
    case EstimatorId::rigau_chi2:
    case EstimatorId::rigau_hellinger:
      return 1.0;
    case EstimatorId::cycles:  // dark pixels: see below
      return 0.5;
    case EstimatorId::variance:
    case EstimatorId::oracle:
      return 2.0;
    case EstimatorId::oracle_expected:
    case EstimatorId::lottery:
    case EstimatorId::endless:
      break;  // controls are not walked
  }
  return -1.0;
}

TEST(Estimators, FollowTheExposureByAKnownPower) {
  constexpr float scale = 16.0f;
  each_row([](const Estimator& row) {
    SampledPicture picture(4, 4, 16, Noise(5, 0.5f));
    SampledPicture bright = picture;
    if (row.key == EstimatorId::cycles) {
      // Far below 1, but far above the 1e-4 that keeps it from dividing by 0.
      for (auto& samples : picture.samples) {
        for (glm::vec3& sample : samples) {
          sample *= 0x1p-8f;
        }
      }
      bright = picture;
    }
    for (std::size_t i = 0; i < 16; ++i) {
      for (glm::vec3& sample : bright.samples[i]) {
        sample *= scale;
      }
      bright.truth[i] *= scale;
    }
    const std::vector<float> a = picture.errors(row);
    const std::vector<float> b = bright.errors(row);
    const double factor = std::pow(double(scale), power_of_scale(row.key));
    const double tolerance = row.key == EstimatorId::cycles ? 2e-3 : 1e-5;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(b[i], factor * double(a[i]), tolerance * factor * double(a[i]));
    }
  });
  // Above 1 Cycles divides by the mean itself.
  SampledPicture picture(4, 4, 16, Noise(5, 0.1f));
  SampledPicture bright = picture;
  for (auto& samples : bright.samples) {
    for (glm::vec3& sample : samples) {
      sample *= scale;
    }
  }
  const Estimator& cycles = estimator(EstimatorId::cycles);
  const std::vector<float> a = picture.errors(cycles);
  const std::vector<float> b = bright.errors(cycles);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(b[i], a[i], 1e-4f * a[i]);
  }
}

TEST(Estimators, AWiderSpreadIsALargerError) {
  each_row([](const Estimator& row) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    // The same pattern of deviations in every pixel and, for those that look at neighbours, from
    // pixel to pixel, at growing amplitude around the same mean.
    std::vector<glm::vec3> pattern(160);
    for (glm::vec3& each : pattern) {
      each = {uniform(random), uniform(random), uniform(random)};
    }
    std::vector<float> before(std::size_t(row.channels) * 16, 0.0f);
    for (const float amplitude : {0.01f, 0.1f, 0.4f, 0.9f}) {
      SampledPicture picture(4, 4, 10, [&](std::size_t pixel, std::size_t i) {
        return glm::vec3(1.0f) + amplitude * pattern[10 * pixel + i];
      });
      picture.truth.assign(16, glm::vec3(1.0f));
      const std::vector<float> errors = picture.errors(row);
      for (std::size_t i = 0; i < errors.size(); ++i) {
        EXPECT_GT(errors[i], before[i]) << "amplitude " << amplitude;
      }
      before = errors;
    }
  });
}

TEST(Estimators, GoldenWindowsAsSamplesOfOnePixel) {
  constexpr std::array rows{EstimatorId::rigau_kl, EstimatorId::rigau_chi2,
                            EstimatorId::rigau_hellinger};
  const auto windows = golden_windows();
  ASSERT_EQ(windows.size(), 17u);
  for (const GoldenWindow& golden : windows) {
    SCOPED_TRACE(golden.name);
    const SampledPicture picture(1, 1, golden.window().size(), [&](std::size_t, std::size_t i) {
      return glm::vec3(golden.channels[0][i], golden.channels[1][i], golden.channels[2][i]);
    });
    for (std::size_t d = 0; d < rows.size(); ++d) {
      const double expected = golden.divergence(all_divergences[d]);
      // Samples are in single precision, which rounds the 1.0001 of one window.
      const double n = double(golden.window().size());
      const double rounding = 0x1p-24 * golden.window().mean_luminance() / n;
      const double tolerance = expected < 1e-6 ? 1e-7 : 1e-5 * expected + rounding;
      EXPECT_NEAR(picture.errors(estimator(rows[d]))[0], expected, tolerance);
    }
  }
}

TEST(Estimators, RigauChi2IsPopulationDeviationOverN) {
  const SampledPicture picture(6, 6, 40, Noise(7));
  const std::vector<float> errors = picture.errors(estimator(EstimatorId::rigau_chi2));
  for (std::size_t i = 0; i < errors.size(); ++i) {
    double mean = 0.0;
    double squares = 0.0;
    for (const glm::vec3& sample : picture.samples[i]) {
      const double l = luminance(sample);
      mean += l / 40.0;
      squares += l * l / 40.0;
    }
    EXPECT_NEAR(errors[i], std::sqrt(squares - mean * mean) / 40.0, 1e-6 * double(errors[i]));
  }
}

TEST(Estimators, OneHotSamples) {
  constexpr double n = 32.0;
  const SampledPicture picture(1, 1, 32, [](std::size_t, std::size_t i) {
    return glm::vec3(i == 20 ? float(n) : 0.0f);  // mean 1
  });
  const auto divergence = [&](EstimatorId id) {
    const double scaled = n * double(picture.errors(estimator(id))[0]);
    return scaled * scaled;
  };
  EXPECT_NEAR(divergence(EstimatorId::rigau_kl), std::log(n), 1e-5);
  EXPECT_NEAR(divergence(EstimatorId::rigau_chi2), n - 1.0, 1e-4);
  EXPECT_NEAR(divergence(EstimatorId::rigau_hellinger), 1.0 - 1.0 / std::sqrt(n), 1e-6);
}

TEST(Estimators, IntervalsHoldTheirConfidence) {
  // Of normal samples the interval of the mean holds the true mean, and the bound of its variance
  // the true one, with probability 0.95: over 20 000 pixels the shares lie within 4 standard
  // deviations, 0.0062 (false alarm 6e-5 each).
  std::mt19937 random(8);
  std::normal_distribution<float> normal(10.0f, 1.0f);
  constexpr std::size_t pixels = 20'000;
  for (const std::size_t count : {2u, 3u, 8u}) {
    const SampledPicture picture(
        200, 100, count, [&](std::size_t, std::size_t) { return glm::vec3(normal(random)); });
    const auto half_widths = picture.errors(estimator(EstimatorId::confidence));
    const auto bounds = picture.errors(estimator(EstimatorId::variance));
    std::size_t held = 0;
    std::size_t bounded = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double mean = mean_of(picture.samples[i]).x;
      held += std::abs(mean - 10.0) <= double(half_widths[i]) * mean ? 1 : 0;
      bounded += double(bounds[i]) >= 1.0 / double(count) ? 1 : 0;
    }
    EXPECT_NEAR(double(held) / double(pixels), 0.95, 0.0062) << count;
    EXPECT_NEAR(double(bounded) / double(pixels), 0.95, 0.0062) << count;
  }
}

TEST(Estimators, CyclesAsksForItsMinimum) {
  const auto minimum = estimator(EstimatorId::cycles).minimum_samples;
  EXPECT_EQ(minimum({0.01f, 0.0f, 0.0f}), 64u);
  EXPECT_EQ(minimum({0.1f, 0.0f, 0.0f}), 32u);
  EXPECT_EQ(minimum({0.001f, 0.0f, 0.0f}), 128u);
  EXPECT_EQ(minimum({1e6f, 0.0f, 0.0f}), 4u);
  EXPECT_LE(minimum({1e-9f, 0.0f, 0.0f}), 1'000'000u);
}

TEST(SampleHalf, ClassAIsHalfOfEveryFour) {
  // Bits 1 and 3 of the index: 0011 1100, and so on.
  for (const std::uint32_t index : {2u, 3u, 4u + 2u, 4u + 3u, 8u, 9u, 12u, 13u}) {
    EXPECT_TRUE(is_in_half(SampleHalf::class_a, index)) << index;
  }
  for (std::uint32_t four = 0; four < 4096; four += 4) {
    int in = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
      in += is_in_half(SampleHalf::class_a, four + i) ? 1 : 0;
    }
    EXPECT_EQ(in, 2) << four;
  }
}

}  // namespace
}  // namespace quartet
