// The kernels over neighbours against the definitions of window.h.

#include <gtest/gtest.h>

#include <random>

#include "renderer/adaptive/estimators/estimator.h"
#include "tests/adaptive/golden_windows.h"

namespace quartet {
namespace {

constexpr std::array window_estimators{EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2,
                                       EstimatorId::hellinger};

Film film_of(int width, int height, auto&& radiance) {
  Film film(width, height);
  for (std::size_t i = 0; i < film.size(); ++i) {
    const glm::vec3 value = radiance(i);
    film.add(i, {&value, 1});
  }
  return film;
}

std::size_t pixel_at(const Film& film, int x, int y) {
  return std::size_t(y) * std::size_t(film.width()) + std::size_t(x);
}

/// The windows around pixel (x, y), in double precision.
GoldenWindow window_around(const Film& film, int x, int y) {
  GoldenWindow window;
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, film.height() - 1); ++ny) {
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, film.width() - 1); ++nx) {
      for (std::size_t c = 0; c < 3; ++c) {
        window.channels[c].push_back(film.mean(int(c))[pixel_at(film, nx, ny)]);
      }
    }
  }
  return window;
}

/// What single precision can hold. A luminance is rounded to half a unit in the last place (2⁻²⁴),
/// once as the mean of a pixel and once as a sum of three channels; σ/n inherits that rounding, and
/// the formulas add a relative error of their own.
double tolerance(double expected, double mean, double n) {
  return 1e-5 * expected + 0x1p-22 * mean / n;
}

void expect_agreement(const Film& film) {
  std::vector<float> contrasts(3 * film.size());
  estimator(EstimatorId::contrast).estimate({film}, contrasts);
  std::array<std::vector<float>, 3> errors;
  for (auto& plane : errors) {
    plane.resize(film.size());
  }
  estimator(EstimatorId::kl).estimate({film}, errors[0]);
  estimator(EstimatorId::chi2).estimate({film}, errors[1]);
  estimator(EstimatorId::hellinger).estimate({film}, errors[2]);
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const std::size_t i = pixel_at(film, x, y);
      const GoldenWindow exact = window_around(film, x, y);
      const double mean = exact.window().mean_luminance();
      const double n = double(exact.window().size());
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(contrasts[c * film.size() + i], contrast<double>(exact.channels[c]), 1e-6);
      }
      for (std::size_t d = 0; d < 3; ++d) {
        const double expected = divergence_error(all_divergences[d], exact.window());
        ASSERT_NEAR(errors[d][i], expected, tolerance(expected, mean, n))
            << "divergence " << d << " at " << x << ", " << y << " of " << film.width() << "x"
            << film.height();
      }
    }
  }
}

TEST(WindowKernels, AgreeWithBruteForceAtEverySize) {
  std::mt19937 random(1);
  std::exponential_distribution<float> radiance(1.0f);
  const auto noise = [&](std::size_t) {
    return glm::vec3(radiance(random), radiance(random), radiance(random));
  };
  for (int height = 1; height <= 5; ++height) {
    for (int width = 1; width <= 20; ++width) {
      expect_agreement(film_of(width, height, noise));
    }
  }
}

TEST(WindowKernels, AgreeFromNearlyEqualToFireflies) {
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  for (const float spread : {1e-6f, 1e-4f, 1e-2f, 0.3f, 1.0f, 3.0f, 8.0f}) {
    for (const float scale : {1e-6f, 1.0f, 1e6f}) {
      expect_agreement(film_of(33, 5, [&](std::size_t) {
        return scale * glm::vec3(std::exp(spread * normal(random)),
                                 std::exp(spread * normal(random)),
                                 std::exp(spread * normal(random)));
      }));
    }
  }
}

TEST(WindowKernels, AgreeWithManyBlackPixels) {
  std::mt19937 random(3);
  std::bernoulli_distribution lit(0.2);
  expect_agreement(
      film_of(40, 30, [&](std::size_t) { return glm::vec3(lit(random) ? 2.5f : 0.0f); }));
}

TEST(WindowKernels, GoldenWindows) {
  const auto windows = golden_windows();
  ASSERT_EQ(windows.size(), 17u);
  for (const GoldenWindow& golden : windows) {
    SCOPED_TRACE(golden.name);
    // The corner pixel of a 2 × 2 and the middle one of a 3 × 2 or 3 × 3 picture see it all.
    const std::size_t n = golden.window().size();
    const int width = n == 4 ? 2 : 3;
    const Film film = film_of(width, int(n) / width, [&](std::size_t i) {
      return glm::vec3(golden.channels[0][i], golden.channels[1][i], golden.channels[2][i]);
    });
    expect_agreement(film);
  }
}

TEST(WindowKernels, ConstantWindowsHaveNoError) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> exponent(-30.0f, 30.0f);
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 value(std::pow(10.0f, exponent(random)), std::pow(10.0f, exponent(random)),
                          std::pow(10.0f, exponent(random)));
    const Film film = film_of(11, 4, [&](std::size_t) { return value; });
    for (const EstimatorId id : window_estimators) {
      const Estimator& row = estimator(id);
      std::vector<float> error(std::size_t(row.channels) * film.size(), 1.0f);
      row.estimate({film}, error);
      for (const float e : error) {
        ASSERT_EQ(e, 0.0f) << row.id << " of " << value.x << ", " << value.y << ", " << value.z;
      }
    }
  }
}

TEST(WindowKernels, FiniteForEveryFiniteInput) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> exponent(-30.0f, 30.0f);
  std::bernoulli_distribution black(0.3);
  for (int i = 0; i < 300; ++i) {
    const Film film = film_of(13, 5, [&](std::size_t) {
      const auto value = [&] { return black(random) ? 0.0f : std::pow(10.0f, exponent(random)); };
      return glm::vec3(value(), value(), value());
    });
    for (const EstimatorId id : window_estimators) {
      const Estimator& row = estimator(id);
      std::vector<float> error(std::size_t(row.channels) * film.size(), -1.0f);
      row.estimate({film}, error);
      for (const float e : error) {
        ASSERT_TRUE(std::isfinite(e) && e >= 0.0f) << row.id << " gives " << e;
      }
    }
  }
}

}  // namespace
}  // namespace quartet
