#include "renderer/measure/reference/possible_truths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "renderer/measure/metrics.h"
#include "renderer/measure/reference/reference_render.h"

namespace quartet {
namespace {

constexpr int floor_width = 60;
constexpr int floor_height = 40;

using Halves = std::array<RadianceImage, 2>;

RadianceImage mean_of(const Halves& halves) {
  RadianceImage mean = halves[0];
  for (std::size_t i = 0; i < mean.size(); ++i) {
    mean.pixels()[i] = 0.5f * (halves[0].pixels()[i] + halves[1].pixels()[i]);
  }
  return mean;
}

Halves halves_of(const std::function<glm::vec3(int, int)>& value, float noise) {
  Halves halves{RadianceImage(floor_width, floor_height), RadianceImage(floor_width, floor_height)};
  std::mt19937 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in each run
  for (RadianceImage& half : halves) {
    for (int y = 0; y < floor_height; ++y) {
      for (int x = 0; x < floor_width; ++x) {
        const float u = float(random() >> 8) * 0x1p-23f - 1.0f;
        half.at(x, y) = value(x, y) + glm::vec3(noise * u);
      }
    }
  }
  return halves;
}

double mean_square(const RadianceImage& a, const RadianceImage& b) {
  return metric(MetricId::mse).compute(a, b);
}

glm::vec3 checkers(int x, int y) {
  return glm::vec3((x / 2 + y / 2) % 2 == 0 ? 0.2f : 2.0f);
}

TEST(PossibleTruths, WithoutNoiseThePictureIsTheTruth) {
  const Halves halves = halves_of(checkers, 0.0f);
  for (const RadianceImage& truth : possible_truths(halves[0], halves, 1.0)) {
    EXPECT_EQ(truth, halves[0]);
  }
}

TEST(PossibleTruths, AreAsFarFromThePictureAsTheNoise) {
  for (const float noise : {0.01f, 0.1f}) {
    const Halves halves = halves_of(checkers, noise);
    const RadianceImage image = mean_of(halves);
    for (const double sigma : {1.0, 2.0}) {
      const auto truths = possible_truths(image, halves, sigma);
      const double squares = 0.5 * (mean_square(truths[0], image) + mean_square(truths[1], image));
      EXPECT_NEAR(squares, mean_square(halves[0], image), 1e-3 * squares);
    }
  }
}

TEST(PossibleTruths, NoiseOnAFlatWallIsTakenOut) {
  const Halves halves = halves_of([](int, int) { return glm::vec3(1.0f); }, 0.5f);
  const RadianceImage image = mean_of(halves);
  const RadianceImage wall(floor_width, floor_height, glm::vec3(1.0f));
  for (const RadianceImage& truth : possible_truths(image, halves, 2.0)) {
    EXPECT_LT(mean_square(truth, wall), 0.3 * mean_square(image, wall));
  }
}

TEST(PossibleTruths, ATextureStays) {
  const Halves halves = halves_of(checkers, 0.1f);
  const RadianceImage image = mean_of(halves);
  const double noise = mean_square(halves[0], image);
  RadianceImage truth(floor_width, floor_height);
  for (int y = 0; y < floor_height; ++y) {
    for (int x = 0; x < floor_width; ++x) {
      truth.at(x, y) = checkers(x, y);
    }
  }
  for (const RadianceImage& possible : possible_truths(image, halves, 2.0)) {
    EXPECT_LT(mean_square(possible, truth), 3.0 * noise);
  }
}

TEST(PossibleTruths, WhereThereAreNoNeighboursTheNoiseIsThePixelsOwn) {
  const Halves halves{RadianceImage(1, 1, glm::vec3(3.0f)), RadianceImage(1, 1, glm::vec3(1.0f))};
  const auto truths = possible_truths(mean_of(halves), halves, 1.0);
  EXPECT_EQ(truths[0].at(0, 0), glm::vec3(3.0f));
  EXPECT_EQ(truths[1].at(0, 0), glm::vec3(1.0f));
}

TEST(PossibleTruths, APixelThatIsNotFiniteIsNoNeighbour) {
  Halves halves = halves_of(checkers, 0.1f);
  halves[0].at(5, 5) = glm::vec3(std::numeric_limits<float>::infinity());
  const RadianceImage image = mean_of(halves);
  for (const RadianceImage& truth : possible_truths(image, halves, 1.0)) {
    for (int y = 0; y < floor_height; ++y) {
      for (int x = 0; x < floor_width; ++x) {
        EXPECT_EQ(std::isfinite(truth.at(x, y).x), x != 5 || y != 5) << x << ", " << y;
      }
    }
  }
}

/// A source whose mean is known.
struct KnownLight {
  const char* what;
  double mean_light;  ///< added to the picture
  float chance;       ///< of a sample that has it all
  float noise;        ///< relative, of the rest
};

RadianceImage truth_of(const KnownLight& light) {
  RadianceImage truth(floor_width, floor_height);
  for (int y = 0; y < floor_height; ++y) {
    for (int x = 0; x < floor_width; ++x) {
      truth.at(x, y) =
          glm::vec3((y / 8) % 2 == 0 ? 0.1f : 0.4f) + glm::vec3(float(light.mean_light));
    }
  }
  return truth;
}

SampleSource source_of(const KnownLight& light, std::uint64_t seed) {
  return [light, seed](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      std::seed_seq place{std::uint32_t(seed), std::uint32_t(x), std::uint32_t(y),
                          first + std::uint32_t(i)};
      std::array<std::uint32_t, 2> bits{};
      place.generate(bits.begin(), bits.end());
      const float u = float(bits[0] >> 8) * 0x1p-24f;
      const float wall = (y / 8) % 2 == 0 ? 0.1f : 0.4f;
      radiance[i] = glm::vec3(wall * (1.0f + light.noise * (2.0f * u - 1.0f)));
      if (float(bits[1] >> 8) * 0x1p-24f < light.chance) {
        radiance[i] += glm::vec3(float(light.mean_light) / light.chance);
      }
    }
  };
}

/// Against what the truth itself says, over 4 references of 32 samples each: in all metrics within
/// a quarter. Of the rare light two pixels in three have seen nothing.
TEST(NoiseFloor, IsWhatATruePictureIsGiven) {
  for (const KnownLight& light :
       {KnownLight{"noise", 0.0, 0.0f, 0.9f}, KnownLight{"rare light", 0.1, 1.0f / 80.0f, 0.05f}}) {
    const RadianceImage truth = truth_of(light);
    std::vector<double> measured(metrics().size());
    std::vector<double> claimed(metrics().size());
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      RenderSettings size;
      size.width = floor_width;
      size.height = floor_height;
      ReferenceRender render({source_of(light, 2 * seed), source_of(light, 2 * seed + 1)}, size);
      render.add(32);
      const auto reference = render.reference();
      for (std::size_t m = 0; m < metrics().size(); ++m) {
        measured[m] += 0.25 * metrics()[m].compute(truth, reference->image);
        claimed[m] += 0.25 * reference->noise_floor(metrics()[m].key);
      }
    }
    for (std::size_t m = 0; m < metrics().size(); ++m) {
      const Metric& row = metrics()[m];
      SCOPED_TRACE(std::string(light.what) + ", " + std::string(row.id));
      EXPECT_NEAR(claimed[m], measured[m],
                  row.scale == MetricScale::decibels ? 1.0 : 0.25 * measured[m]);
    }
  }
}

}  // namespace
}  // namespace quartet
