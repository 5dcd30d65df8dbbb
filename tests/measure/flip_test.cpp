#include "renderer/measure/flip.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

// LDR-FLIP again, straight from the paper's constants: in double, with two-dimensional kernels that
// are not taken apart, and with the matrix of Rec. 709 from its primaries. Slow and plain.

namespace quartet {
namespace {

constexpr double pixels_per_degree = 67.0206;
const glm::dvec3 white(0.950428545, 1.0, 1.088900371);

/// XYZ of the primaries, scaled so that they add up to white.
glm::dmat3 rec709() {
  const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1.0, (1.0 - x - y) / y); };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const glm::dvec3 scale = glm::inverse(primaries) * white;
  return {primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
}

glm::dvec3 ycxcz(glm::dvec3 rgb) {
  const glm::dvec3 t = rec709() * glm::clamp(rgb, 0.0, 1.0) / white;
  return {116.0 * t.y - 16.0, 500.0 * (t.x - t.y), 200.0 * (t.y - t.z)};
}

glm::dvec3 rgb_of_ycxcz(glm::dvec3 c) {
  const double y = (c.x + 16.0) / 116.0;
  return glm::inverse(rec709()) * (glm::dvec3(y + c.y / 500.0, y, y - c.z / 200.0) * white);
}

glm::dvec3 hunt_lab(glm::dvec3 rgb) {
  const glm::dvec3 t = rec709() * glm::clamp(rgb, 0.0, 1.0) / white;
  const auto f = [](double v) {
    const double d = 6.0 / 29.0;
    return v > d * d * d ? std::cbrt(v) : v / (3 * d * d) + 4.0 / 29.0;
  };
  const double lightness = 116 * f(t.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(t.x) - f(t.y)),
          0.01 * lightness * 200 * (f(t.y) - f(t.z))};
}

double color_error(glm::dvec3 lab1, glm::dvec3 lab2) {
  const auto distance = [](glm::dvec3 a, glm::dvec3 b) {
    return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
  };
  const double largest = distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
  const double knee = 0.4 * largest;
  const double d = distance(lab1, lab2);
  return d < knee ? 0.95 * d / knee : 0.95 + 0.05 * (d - knee) / (largest - knee);
}

/// A kernel of (2 radius + 1)² weights.
struct Kernel2d {
  int radius;
  std::vector<double> weights;
  double& at(int x, int y) {
    return weights[std::size_t((y + radius) * (2 * radius + 1) + x + radius)];
  }
};

template <class Weight>
Kernel2d kernel(int radius, const Weight& weight) {
  Kernel2d result{radius, std::vector<double>(std::size_t((2 * radius + 1) * (2 * radius + 1)))};
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      result.at(x, y) = weight(double(x), double(y));
    }
  }
  return result;
}

/// Positive weights add up to 1, negative ones to −1.
Kernel2d normalised(Kernel2d k) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double w : k.weights) {
    (w > 0 ? positive : negative) += std::abs(w);
  }
  for (double& w : k.weights) {
    w /= w > 0 ? positive : negative;
  }
  return k;
}

Kernel2d sensitivity(double a1, double b1, double a2, double b2) {
  const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) *
                                   pixels_per_degree));
  return normalised(kernel(radius, [&](double x, double y) {
    const double d2 = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
    return a1 * std::sqrt(std::numbers::pi / b1) *
               std::exp(-std::numbers::pi * std::numbers::pi * d2 / b1) +
           a2 * std::sqrt(std::numbers::pi / b2) *
               std::exp(-std::numbers::pi * std::numbers::pi * d2 / b2);
  }));
}

using Plane = Image<double>;

Plane convolved(const Plane& in, Kernel2d k) {
  Plane out(in.width(), in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      for (int j = -k.radius; j <= k.radius; ++j) {
        for (int i = -k.radius; i <= k.radius; ++i) {
          out.at(x, y) += k.at(i, j) * in.at(std::clamp(x + i, 0, in.width() - 1),
                                             std::clamp(y + j, 0, in.height() - 1));
        }
      }
    }
  }
  return out;
}

struct Seen {
  Image<glm::dvec3> lab;
  Plane edges, points;
};

Seen seen(const RadianceImage& image) {
  const int w = image.width();
  const int h = image.height();
  std::array<Plane, 3> planes;
  planes.fill(Plane(w, h));
  Plane lightness(w, h);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const glm::dvec3 c = ycxcz(glm::dvec3(image.pixels()[i]));
    for (int k = 0; k < 3; ++k) {
      planes[std::size_t(k)].pixels()[i] = c[k];
    }
    lightness.pixels()[i] = (c.x + 16) / 116;
  }
  const std::array<Plane, 3> blurred{convolved(planes[0], sensitivity(1, 0.0047, 0, 1e-5)),
                                     convolved(planes[1], sensitivity(1, 0.0053, 0, 1e-5)),
                                     convolved(planes[2], sensitivity(34.1, 0.04, 13.5, 0.025))};
  const double sd = 0.5 * 0.082 * pixels_per_degree;
  const int radius = int(std::ceil(3 * sd));
  const auto bell = [&](double x, double y) { return std::exp(-(x * x + y * y) / (2 * sd * sd)); };
  const auto edge = [&](double x, double y) { return -x * bell(x, y); };
  const auto point = [&](double x, double y) { return (x * x / (sd * sd) - 1) * bell(x, y); };
  const auto turned = [](const auto& f) { return [&f](double x, double y) { return f(y, x); }; };
  const auto magnitude = [&](const auto& f) {
    const Plane x = convolved(lightness, normalised(kernel(radius, f)));
    const Plane y = convolved(lightness, normalised(kernel(radius, turned(f))));
    Plane result(w, h);
    for (std::size_t i = 0; i < result.size(); ++i) {
      result.pixels()[i] = std::hypot(x.pixels()[i], y.pixels()[i]);
    }
    return result;
  };
  Seen result{Image<glm::dvec3>(w, h), magnitude(edge), magnitude(point)};
  for (std::size_t i = 0; i < image.size(); ++i) {
    result.lab.pixels()[i] = hunt_lab(
        rgb_of_ycxcz({blurred[0].pixels()[i], blurred[1].pixels()[i], blurred[2].pixels()[i]}));
  }
  return result;
}

Plane plain_flip(const RadianceImage& test, const RadianceImage& reference) {
  const Seen a = seen(test);
  const Seen b = seen(reference);
  Plane map(test.width(), test.height());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double feature =
        std::sqrt(std::max(std::abs(a.edges.pixels()[i] - b.edges.pixels()[i]),
                           std::abs(a.points.pixels()[i] - b.points.pixels()[i])) /
                  std::numbers::sqrt2);
    map.pixels()[i] = std::pow(color_error(a.lab.pixels()[i], b.lab.pixels()[i]), 1.0 - feature);
  }
  return map;
}

RadianceImage flat(glm::vec3 color) {
  return {41, 23, color};
}

RadianceImage noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0.0f, 1.2f);  // some above what a display shows
  RadianceImage image(width, height);
  for (glm::vec3& c : image.pixels()) {
    c = {value(random), value(random), value(random)};
  }
  return image;
}

/// Single precision, and the square root of the features' difference.
void expect_like_plain(const RadianceImage& test, const RadianceImage& reference) {
  const ScalarImage map = flip_map(test, reference);
  const Plane expected = plain_flip(test, reference);
  double worst = 0.0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    worst = std::max(worst, std::abs(double(map.pixels()[i]) - expected.pixels()[i]));
  }
  EXPECT_LT(worst, 5e-4);
}

// The contrast sensitivity of a flat picture is the picture, and it has no edges or points: what is
// left is the distance of two colours.
TEST(Flip, OfFlatColoursIsTheDistanceOfTheTwo) {
  const std::vector<std::pair<glm::vec3, glm::vec3>> pairs{
      {{0, 0, 0}, {1, 1, 1}},
      {{1, 0, 0}, {0, 1, 0}},
      {{0, 1, 0}, {0, 0, 1}},
      {{0.5f, 0.5f, 0.5f}, {0.51f, 0.5f, 0.5f}},
      {{0.2f, 0.4f, 0.1f}, {0.3f, 0.1f, 0.6f}},
      {{0.001f, 0.002f, 0}, {0.002f, 0.001f, 0.003f}}};
  for (const auto& [a, b] : pairs) {
    const double expected = color_error(hunt_lab(glm::dvec3(a)), hunt_lab(glm::dvec3(b)));
    const ScalarImage map = flip_map(flat(a), flat(b));
    for (const float value : map.pixels()) {
      ASSERT_NEAR(value, expected, 2e-4 * expected + 1e-6);
    }
    EXPECT_NEAR(flip(flat(a), flat(b)), expected, 2e-4 * expected + 1e-6);
  }
}

TEST(Flip, NumbersOfTheDefinitionByHand) {
  // Computed apart from this program: Lab after Hunt of green and of blue, the most different
  // colours, is (87.7362, −75.6099, 72.9812) and (32.2982, 25.5781, −34.8364).
  const double largest =
      std::pow((87.7362 - 32.2982) + std::hypot(-75.6099 - 25.5781, 72.9812 + 34.8364), 0.7);
  EXPECT_NEAR(largest, 41.2761, 1e-4);
  const double gray = std::pow(116 * (std::cbrt(0.5) - std::cbrt(0.25)), 0.7);
  EXPECT_NEAR(flip(flat(glm::vec3(0.5f)), flat(glm::vec3(0.25f))), gray * 0.95 / (0.4 * largest),
              1e-4);
  const double black_white = std::pow(100.0, 0.7);
  EXPECT_NEAR(flip(flat(glm::vec3(0.0f)), flat(glm::vec3(1.0f))),
              0.95 + 0.05 * (black_white / largest - 0.4) / 0.6, 1e-4);
}

TEST(Flip, EndsOfItsScale) {
  EXPECT_GT(flip(flat(glm::vec3(0.0f)), flat(glm::vec3(1.0f))), 0.95);
  EXPECT_NEAR(flip(flat({0, 1, 0}), flat({0, 0, 1})), 1.0, 1e-5);
  const RadianceImage image = noise(50, 40, 1);
  const ScalarImage nothing = flip_map(image, image);
  EXPECT_TRUE(std::ranges::all_of(nothing.pixels(), [](float v) { return v == 0.0f; }));
  const ScalarImage map = flip_map(image, noise(50, 40, 2));
  EXPECT_TRUE(std::ranges::all_of(map.pixels(), [](float v) { return v > 0.0f && v <= 1.0f; }));
}

TEST(Flip, IsSymmetric) {
  const RadianceImage a = noise(45, 33, 3);
  const RadianceImage b = noise(45, 33, 4);
  EXPECT_EQ(flip_map(a, b), flip_map(b, a));
}

TEST(Flip, OfEdgesPointsAndNoiseIsThePlainOne) {
  const glm::vec3 gray(0.3f);
  RadianceImage edge(40, 30, gray);
  for (int y = 0; y < 30; ++y) {
    for (int x = 22; x < 40; ++x) {
      edge.at(x, y) = {0.7f, 0.6f, 0.2f};
    }
  }
  expect_like_plain(edge, RadianceImage(40, 30, gray));
  RadianceImage moved(40, 30, gray);
  for (int y = 0; y < 30; ++y) {
    for (int x = 20; x < 40; ++x) {
      moved.at(x, y) = {0.7f, 0.6f, 0.2f};
    }
  }
  expect_like_plain(edge, moved);
  RadianceImage point(31, 31, gray);
  point.at(15, 15) = glm::vec3(1.0f);
  point.at(0, 30) = glm::vec3(1.0f);  // a corner, whose colour goes on beyond it
  expect_like_plain(point, RadianceImage(31, 31, gray));
  expect_like_plain(noise(36, 27, 5), noise(36, 27, 6));
  expect_like_plain(noise(1, 1, 7), noise(1, 1, 8));
  expect_like_plain(noise(3, 40, 9), noise(3, 40, 10));
}

TEST(Flip, SeesAPointMoreThanTheSameDifferenceInABlur) {
  RadianceImage point(60, 60, glm::vec3(0.2f));
  RadianceImage spread(60, 60, glm::vec3(0.2f));
  for (int y = 26; y < 34; ++y) {
    for (int x = 26; x < 34; ++x) {
      point.at(x, y) = glm::vec3(0.8f);
    }
  }
  for (glm::vec3& c : spread.pixels()) {
    c += 0.6f * 64.0f / 3600.0f;
  }
  const RadianceImage plain(60, 60, glm::vec3(0.2f));
  const ScalarImage near = flip_map(point, plain);
  const ScalarImage far = flip_map(spread, plain);
  EXPECT_GT(near.at(30, 30), 5.0f * far.at(30, 30));
}

TEST(Flip, DoesNotDependOnTheNumberOfThreads) {
  const RadianceImage a = noise(211, 133, 11);
  const RadianceImage b = noise(211, 133, 12);
  tbb::task_arena one(1);
  const ScalarImage expected = one.execute([&] { return flip_map(a, b); });
  for (const int threads : {2, 8}) {
    tbb::task_arena arena(threads);
    EXPECT_EQ(arena.execute([&] { return flip_map(a, b); }), expected);
  }
}

}  // namespace
}  // namespace quartet
