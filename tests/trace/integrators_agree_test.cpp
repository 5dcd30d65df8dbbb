#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "renderer/files/exr.h"
#include "renderer/trace/integrator.h"
#include "tests/trace/statistics.h"
#include "tests/trace/test_scenes.h"

// Both integrators must give the same picture of every scene that comes with Quartet, each pixel
// and each region within what noise explains, at a false-alarm rate of 1e-3 over all pixels,
// regions, channels and scenes.
//
// What is compared are means of batches, each with a seed of its own, because samples of one seed
// are stratified and so not independent. A difference of means over its standard error is judged by
// Student's t. Where light is found by luck the mean of a pixel and its spread are correlated (few
// hits make both small), which would give t long tails; so the spread comes from other batches than
// the mean: the first half judges the second, and the other way round.
//
// A mean is normal only as far as skewness allows. Batches with a skewness above 1 are not judged
// on their own, only as parts of their regions: pixels that one path in thousands makes bright. At
// that limit the mean of 63 batches has skewness 0.13, which makes the tail beyond 6 standard
// errors up to exp(0.13 · 6³ / 6) = 100 times likelier (Cramér 1938); at the typical 0.3 it is 4
// times. Hence the nominal rate of 1e-4.

namespace quartet {
namespace {

using namespace test;

constexpr int width = 12;
constexpr int half = 63;  // batches; an even number of degrees of freedom in each half
constexpr int batches = 2 * half;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int mis_batch = 64;         // samples
constexpr double noticeable = 1.5;    // factor on a quarter of the picture
constexpr double least_judged = 0.2;  // share of pixels and regions
#else
constexpr int mis_batch = 256;
constexpr double noticeable = 1.1;
constexpr double least_judged = 0.4;
#endif
constexpr int kajiya_batch = 3 * mis_batch / 2;
constexpr double family = 1e-4;
constexpr double largest_skewness = 1.0;
// A light of the radiance 1800 that one path in 200 000 finds would need billions of paths.
// Transport is linear in each light's radiance, so a scene with dimmer small lights tests the same
// code.
constexpr float brightest = 20.0f;

/// Of a pixel or a region: one mean a batch.
using Batches = std::vector<glm::dvec3>;

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Batches> pixels;
};

Picture render(const TraceScene& scene, RenderSettings settings, int samples) {
  const CameraRays camera(settings.camera, settings.width, settings.height);
  Picture picture{settings.width, settings.height, {}};
  std::vector<glm::vec3> radiance(std::size_t(samples), glm::vec3(0.0f));
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      Batches means;
      for (int batch = 0; batch < batches; ++batch) {
        RenderSettings with_seed = settings;
        with_seed.seed += std::uint64_t(batch);
        integrator(settings.integrator).trace(scene, with_seed, camera, x, y, 0, radiance);
        glm::dvec3 sum(0.0);
        for (const glm::vec3& sample : radiance) {
          EXPECT_TRUE(glm::all(glm::greaterThanEqual(sample, glm::vec3(0.0f))) &&
                      glm::all(glm::lessThan(sample, glm::vec3(1e6f))))
              << "pixel " << x << ", " << y << " batch " << batch << ": " << sample.x << ", "
              << sample.y << ", " << sample.z;
          sum += glm::dvec3(sample);
        }
        means.push_back(sum / double(samples));
      }
      picture.pixels.push_back(std::move(means));
    }
  }
  return picture;
}

/// The mean of a block of pixels, batch by batch.
Batches region(const Picture& picture, int x0, int x1, int y0, int y1) {
  Batches means(std::size_t(batches), glm::dvec3(0.0));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Batches& pixel = picture.pixels[std::size_t(y * picture.width + x)];
      for (std::size_t i = 0; i < means.size(); ++i) {
        means[i] += pixel[i] / double((x1 - x0) * (y1 - y0));
      }
    }
  }
  return means;
}

Moments moments(const Batches& values, int channel, int first) {
  Moments result;
  for (int i = first; i < first + half; ++i) {
    result.add(values[std::size_t(i)][channel]);
  }
  return result;
}

double skewness(const Batches& values, int channel) {
  Moments all;
  for (const glm::dvec3& value : values) {
    all.add(value[channel]);
  }
  double cubes = 0.0;
  for (const glm::dvec3& value : values) {
    cubes += std::pow(value[channel] - all.mean(), 3.0) / double(all.count());
  }
  return all.variance() > 0.0 ? cubes / std::pow(all.variance(), 1.5) : 0.0;
}

struct Comparison {
  struct Test {
    std::string where;
    double p;
  };
  std::vector<Test> tests;
  int too_skewed = 0;

  void add(const Batches& a, const Batches& b, const std::string& where);
  std::vector<Test> failures(double level) const;
};

void Comparison::add(const Batches& a, const Batches& b, const std::string& where) {
  for (int channel = 0; channel < 3; ++channel) {
    if (std::max(skewness(a, channel), skewness(b, channel)) > largest_skewness) {
      ++too_skewed;
      continue;
    }
    for (const int first : {0, half}) {
      const double mean = moments(a, channel, first).mean();
      const double difference = mean - moments(b, channel, first).mean();
      const double error = std::sqrt(moments(a, channel, half - first).variance_of_mean() +
                                     moments(b, channel, half - first).variance_of_mean());
      // Where no light arrives, or all samples are alike, both must say the same.
      const double p = std::abs(difference) <= 1e-6 * mean
                           ? 1.0
                           : two_sided_student_p(difference / error, half - 1);
      tests.push_back({fmt::format("{} channel {}: {:.3g} and {:.3g} ± {:.2g}", where, channel,
                                   mean, mean - difference, error),
                       p});
    }
  }
}

std::vector<Comparison::Test> Comparison::failures(double level) const {
  std::vector<Test> failed;
  std::copy_if(tests.begin(), tests.end(), std::back_inserter(failed),
               [&](const Test& test) { return !(test.p >= level); });
  return failed;
}

/// All tests of two pictures: every pixel, 4 × 3 and 2 × 2 regions, the whole.
Comparison compare(const Picture& a, const Picture& b, const std::string& scene) {
  Comparison comparison;
  for (int i = 0; i < a.width * a.height; ++i) {
    comparison.add(a.pixels[std::size_t(i)], b.pixels[std::size_t(i)],
                   fmt::format("{} pixel {},{}", scene, i % a.width, i / a.width));
  }
  for (const auto& [columns, rows] : {std::pair{4, 3}, {2, 2}, {1, 1}}) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int x0 = column * a.width / columns;
        const int x1 = (column + 1) * a.width / columns;
        const int y0 = row * a.height / rows;
        const int y1 = (row + 1) * a.height / rows;
        comparison.add(region(a, x0, x1, y0, y1), region(b, x0, x1, y0, y1),
                       fmt::format("{} pixels {},{} to {},{}", scene, x0, y0, x1 - 1, y1 - 1));
      }
    }
  }
  return comparison;
}

void write_picture(const Picture& picture, const std::string& name) {
  RadianceImage image(picture.width, picture.height);
  for (int i = 0; i < picture.width * picture.height; ++i) {
    glm::dvec3 mean(0.0);
    for (const glm::dvec3& batch : picture.pixels[std::size_t(i)]) {
      mean += batch / double(batches);
    }
    image.at(i % picture.width, i / picture.width) = glm::vec3(mean);
  }
  ExrImage exr(picture.width, picture.height);
  exr.add_radiance(image);
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / (name + ".exr");
  write_exr(path, exr);
  std::cerr << "wrote " << path << "\n";
}

Scene with_lights_capped(Scene scene) {
  for (Shape& shape : scene.shapes) {
    const glm::vec3 radiance = shape.radiance.value;
    const float largest = std::max({radiance.x, radiance.y, radiance.z});
    if (largest > brightest) {
      shape.radiance.value *= brightest / largest;
    }
  }
  return scene;
}

/// A picture that is too bright by `factor` in its upper left quarter, as a wrong weight would make
/// it.
Picture brightened(Picture picture, double factor) {
  for (int y = 0; y < picture.height / 2; ++y) {
    for (int x = 0; x < picture.width / 2; ++x) {
      for (glm::dvec3& batch : picture.pixels[std::size_t(y * picture.width + x)]) {
        batch *= factor;
      }
    }
  }
  return picture;
}

TEST(IntegratorsAgree, OnEveryScene) {
  const std::vector<std::string> names = builtin_scenes();
  ASSERT_GE(names.size(), 5u);
  int failures = 0;
  int noticed = 0;
  for (const std::string& name : names) {
    const TraceScene scene(with_lights_capped(open_scene(name)));
    RenderSettings settings = default_settings(scene.scene());
    // The scenes where methods fail are many, and most are made to be noisy: fewer pixels there.
    const bool failure = name.starts_with("failures/");
    const int columns = failure ? width / 2 : width;
    settings.height = std::max(3, columns * settings.height / settings.width);
    settings.width = columns;
    settings.seed = 1000;
    // Where nothing but roulette makes noise, a quarter of the samples shows more than elsewhere.
    const int share = scene.scene().path.stem().string().ends_with("furnace") ? 4 : 1;
    settings.integrator = IntegratorId::kajiya;
    const Picture kajiya = render(scene, settings, kajiya_batch / share);
    settings.seed = 2000;
    settings.integrator = IntegratorId::mis;
    const Picture mis = render(scene, settings, mis_batch / share);

    const Comparison comparison = compare(kajiya, mis, name);
    const double number = 2.0 * 3.0 * double(kajiya.pixels.size() + 17) * double(names.size());
    const double level = sidak_level(family, number);
    const auto failed = comparison.failures(level);
    for (const Comparison::Test& test : failed) {
      ADD_FAILURE() << test.where << ", p = " << test.p;
    }
    if (!failed.empty()) {
      const std::string stem = std::filesystem::path(name).stem().string();
      write_picture(kajiya, stem + "-kajiya");
      write_picture(mis, stem + "-mis");
    }
    // The same test must notice a quarter of the picture that is wrong.
    if (failure) {
      ++failures;
      noticed += compare(kajiya, brightened(mis, 1.5), name).failures(level).empty() ? 0 : 1;
      continue;
    }
    const double judged = double(comparison.tests.size()) / 2.0;
    EXPECT_GT(judged / (judged + comparison.too_skewed), least_judged) << name;
    EXPECT_FALSE(compare(kajiya, brightened(mis, noticeable), name).failures(level).empty())
        << name;
  }
  // Not in each: light of the caustic and behind the door is found too seldom.
  EXPECT_GE(noticed, failures - 4);
}

}  // namespace
}  // namespace quartet
