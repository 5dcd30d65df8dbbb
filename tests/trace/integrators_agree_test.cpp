#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image/exr.h"
#include "renderer/trace/integrator.h"
#include "tests/trace/statistics.h"
#include "tests/trace/test_scenes.h"

// Both integrators must give the same picture of every scene that comes with Quartet, each pixel
// and each region within what noise explains. The false-alarm rate is 1e-3 over all pixels,
// regions, channels and scenes.
//
// What is compared are means of batches, each with a seed of its own, because samples of one seed
// are stratified and so not independent. A difference of means over its standard error is judged by
// Student's t. Where light is found by luck the mean of a pixel and its spread are correlated (few
// hits make both small), which would give t long tails; so the spread comes from other batches than
// the mean: the first half judges the second, and the other way round.

namespace quartet {
namespace {

using namespace test;

constexpr int width = 12;
constexpr int half = 63;  // batches; an even number of degrees of freedom in each half
constexpr int batches = 2 * half;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int mis_batch = 64;  // samples
constexpr double noticeable = 1.25;
#else
constexpr int mis_batch = 256;
constexpr double noticeable = 1.1;
#endif
constexpr int kajiya_batch = 3 * mis_batch / 2;
constexpr double family = 1e-3;
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

struct Disagreement {
  std::string where;
  double p;
};

void compare(const Batches& a, const Batches& b, const std::string& where,
             std::vector<Disagreement>& tests) {
  for (int channel = 0; channel < 3; ++channel) {
    for (const int first : {0, half}) {
      const double difference =
          moments(a, channel, first).mean() - moments(b, channel, first).mean();
      const double error = std::sqrt(moments(a, channel, half - first).variance_of_mean() +
                                     moments(b, channel, half - first).variance_of_mean());
      // Where no light arrives, or all samples are alike, both must say the same.
      const double rounding = 1e-6 * moments(a, channel, first).mean();
      const double p = std::abs(difference) <= rounding
                           ? 1.0
                           : two_sided_student_p(difference / error, half - 1);
      tests.push_back({where + " channel " + std::to_string(channel) + " difference " +
                           std::to_string(difference) + " ± " + std::to_string(error),
                       p});
    }
  }
}

/// All tests of two pictures: every pixel, 4 × 3 and 2 × 2 regions, the whole.
std::vector<Disagreement> compare(const Picture& a, const Picture& b, const std::string& scene) {
  std::vector<Disagreement> tests;
  for (int i = 0; i < a.width * a.height; ++i) {
    compare(a.pixels[std::size_t(i)], b.pixels[std::size_t(i)],
            scene + " pixel " + std::to_string(i % a.width) + "," + std::to_string(i / a.width),
            tests);
  }
  for (const auto& [columns, rows] : {std::pair{4, 3}, {2, 2}, {1, 1}}) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int x0 = column * a.width / columns;
        const int x1 = (column + 1) * a.width / columns;
        const int y0 = row * a.height / rows;
        const int y1 = (row + 1) * a.height / rows;
        compare(region(a, x0, x1, y0, y1), region(b, x0, x1, y0, y1),
                scene + " pixels " + std::to_string(x0) + "," + std::to_string(y0) + " to " +
                    std::to_string(x1 - 1) + "," + std::to_string(y1 - 1),
                tests);
      }
    }
  }
  return tests;
}

std::vector<Disagreement> failures(const std::vector<Disagreement>& tests, double level) {
  std::vector<Disagreement> failed;
  std::copy_if(tests.begin(), tests.end(), std::back_inserter(failed),
               [&](const Disagreement& test) { return !(test.p >= level); });
  return failed;
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
  int tests_at_all = 0;
  for (const std::string& name : names) {
    const TraceScene scene(with_lights_capped(load_scene(find_scene(name))));
    RenderSettings settings = default_settings(scene.scene());
    settings.height = std::max(3, width * settings.height / settings.width);
    settings.width = width;
    settings.seed = 1000;
    // Where nothing but roulette makes noise, an eighth of the samples shows more than elsewhere.
    const int share = name == "furnace" ? 8 : 1;
    settings.integrator = IntegratorId::kajiya;
    const Picture kajiya = render(scene, settings, kajiya_batch / share);
    settings.seed = 2000;
    settings.integrator = IntegratorId::mis;
    const Picture mis = render(scene, settings, mis_batch / share);

    const std::vector<Disagreement> tests = compare(kajiya, mis, name);
    const double level = sidak_level(family, double(tests.size() * names.size()));
    const std::vector<Disagreement> failed = failures(tests, level);
    for (const Disagreement& test : failed) {
      ADD_FAILURE() << test.where << ", p = " << test.p;
    }
    if (!failed.empty()) {
      write_picture(kajiya, name + "-kajiya");
      write_picture(mis, name + "-mis");
    }
    tests_at_all += int(tests.size());
    EXPECT_FALSE(failures(compare(kajiya, brightened(mis, noticeable), name), level).empty())
        << name << ": a quarter of the picture may be wrong unnoticed";
  }
  EXPECT_GT(tests_at_all, 3000);
}

}  // namespace
}  // namespace quartet
