#include "renderer/trace/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "renderer/trace/sampler.h"
#include "tests/trace/bsdf_cases.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/statistics.h"

namespace quartet {
namespace {

using namespace test;

std::vector<BsdfSample> samples_of(const Bsdf& bsdf, glm::vec3 wo, std::uint32_t seed,
                                   std::uint32_t count) {
  std::vector<BsdfSample> samples;
  for (std::uint32_t i = 0; i < count; ++i) {
    // Another pixel each: the chi-square test needs independent samples, not stratified ones.
    Sampler sampler(seed, i, 0);
    const Sampler::Draws& d = sampler.next();
    samples.push_back(sample(bsdf, wo, d[2], d[3]));
  }
  return samples;
}

TEST(Bsdf, ReflectsNoMoreThanItReceives) {
  for (const BsdfCase& c : bsdf_cases()) {
    const Bsdf bsdf = bsdf_of(c.material);
    for (const glm::vec3 wo : outgoing()) {
      glm::dvec3 albedo(0.0);
      constexpr std::uint32_t count = 4096;
      for (const BsdfSample& s : samples_of(bsdf, wo, 1, count)) {
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(s.weight, glm::vec3(0.0f)))) << c.name;
        // Seen against the light, transmission gathers radiance; the power is what counts.
        const glm::vec3 power = s.weight * s.eta_scale;
        ASSERT_TRUE(glm::all(glm::lessThanEqual(power, glm::vec3(1.0f + 1e-5f)))) << c.name;
        albedo += glm::dvec3(power) / double(count);
        if (s.weight != glm::vec3(0.0f)) {
          ASSERT_NEAR(glm::length(s.wi), 1.0f, 2e-5f) << c.name;
        }
      }
      if (const Diffuse* diffuse = std::get_if<Diffuse>(&c.material.kind)) {
        for (int channel = 0; channel < 3; ++channel) {
          EXPECT_NEAR(albedo[channel], diffuse->reflectance.value[channel], 1e-6) << c.name;
        }
      }
      if (c.name.starts_with("conductor mirror") || c.name == "dielectric") {
        EXPECT_NEAR(albedo.x, 1.0, 1e-5) << c.name;
      }
      const RoughConductor* rough = std::get_if<RoughConductor>(&c.material.kind);
      if (rough && rough->metal.eta == glm::vec3(0.0f) && rough->alpha <= 0.02f && wo.z > 0.2f) {
        EXPECT_GT(albedo.x, 0.98) << c.name;  // nothing but a little masking is lost
      }
    }
  }
}

TEST(Bsdf, IsReciprocal) {
  int compared = 0;
  for (const BsdfCase& c : bsdf_cases()) {
    const Bsdf bsdf = bsdf_of(c.material);
    for (std::uint32_t i = 0; i < 2000; ++i) {
      Sampler sampler(2, i, 0);
      const Sampler::Draws& d = sampler.next();
      const glm::vec3 wo = square_to_uniform_cap(d[0], d[1], 0.0f);
      // Near the mirror direction too, where smooth materials have their values.
      const glm::vec3 near(wo.x * -1.0f + 0.01f * (d[2] - 0.5f), -wo.y + 0.01f * (d[3] - 0.5f),
                           wo.z);
      const glm::vec3 wi = i % 2 ? square_to_uniform_cap(d[2], d[3], 0.0f) : glm::normalize(near);
      if (wo.z < 0.01f || wi.z < 0.01f) {
        continue;
      }
      const glm::vec3 there = evaluate(bsdf, wo, wi).f_cos / wi.z;
      const glm::vec3 back = evaluate(bsdf, wi, wo).f_cos / wo.z;
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_NEAR(there[channel], back[channel], 1e-4f * there[channel] + 1e-12f)
            << c.name << ", " << wo.z << " and " << wi.z;
      }
      compared += there.x > 0.0f;
    }
  }
  EXPECT_GT(compared, 10000);
}

TEST(Bsdf, SamplesCarryTheirValueOverTheirDensity) {
  for (const BsdfCase& c : bsdf_cases()) {
    const Bsdf bsdf = bsdf_of(c.material);
    for (glm::vec3 wo : outgoing()) {
      for (const float side : {1.0f, -1.0f}) {
        wo.z = std::copysign(wo.z, side);
        for (const BsdfSample& s : samples_of(bsdf, wo, 3, 300)) {
          if (s.weight == glm::vec3(0.0f)) {
            continue;
          }
          ASSERT_TRUE(side > 0.0f || c.material.two_sided || transmits(c.material))
              << c.name << " reflects on its back";
          ASSERT_EQ(s.specular, is_specular(bsdf)) << c.name;
          const BsdfValue value = evaluate(bsdf, wo, s.wi);
          if (s.specular) {
            ASSERT_EQ(s.pdf, 0.0f);
            ASSERT_EQ(value.pdf, 0.0f);
            ASSERT_EQ(value.f_cos, glm::vec3(0.0f));
            continue;
          }
          ASSERT_GT(s.wi.z * wo.z, 0.0f) << c.name << " leaves through the surface";
          ASSERT_GT(s.pdf, 0.0f);
          // Half vectors are rebuilt from directions with 24 bits, which at alpha 1e-4 leaves 10.
          const RoughConductor* rough = std::get_if<RoughConductor>(&c.material.kind);
          const float digits = rough ? 1e-6f / rough->alpha + 1e-5f : 1e-5f;
          ASSERT_NEAR(value.pdf / s.pdf, 1.0f, digits) << c.name;
          for (int channel = 0; channel < 3; ++channel) {
            ASSERT_NEAR(s.weight[channel], value.f_cos[channel] / value.pdf, 1e-4f) << c.name;
          }
        }
      }
    }
  }
}

TEST(Bsdf, TwoSidedIsTheSameSeenFromBehind) {
  for (const BsdfCase& c : bsdf_cases()) {
    if (transmits(c.material)) {
      continue;
    }
    const Bsdf bsdf = bsdf_of(c.material);
    const glm::vec3 wo = direction(0.6f, 1.0f);
    const glm::vec3 wi = direction(0.55f, 1.0f + pi);
    const glm::vec3 flip(1.0f, 1.0f, -1.0f);
    const BsdfValue front = evaluate(bsdf, wo, wi);
    const BsdfValue back = evaluate(bsdf, wo * flip, wi * flip);
    const BsdfSample above = sample(bsdf, wo, 0.4f, 0.8f);
    const BsdfSample below = sample(bsdf, wo * flip, 0.4f, 0.8f);
    EXPECT_EQ(back.pdf, c.material.two_sided ? front.pdf : 0.0f) << c.name;
    EXPECT_EQ(back.f_cos, c.material.two_sided ? front.f_cos : glm::vec3(0.0f)) << c.name;
    EXPECT_EQ(below.weight, c.material.two_sided ? above.weight : glm::vec3(0.0f)) << c.name;
    if (c.material.two_sided) {
      EXPECT_EQ(below.wi * flip, above.wi) << c.name;
    }
    EXPECT_EQ(evaluate(bsdf, wo, wi * flip).f_cos, glm::vec3(0.0f)) << c.name;
    EXPECT_EQ(evaluate(bsdf, wo * flip, wi).f_cos, glm::vec3(0.0f)) << c.name;
  }
}

// ---- sampling against density. Directions are binned over a chart of the hemisphere, and the
// density integrated over each bin. What falls outside of the chart, or is no direction at all, is
// a bin of its own, so that the density is also tested to integrate to what the sampling finds.

struct Chart {
  static constexpr int bins = 24;
  static constexpr int steps = 16;  // of the midpoint rule in a bin, each way

  std::function<bool(glm::vec3 wi, double& a, double& b)> to_chart;  // both in [0, 1)
  std::function<double(double a, double b)> density;                 // per unit square
};

/// Cosine and azimuth.
Chart spherical_chart(const Bsdf& bsdf, glm::vec3 wo) {
  return {[](glm::vec3 wi, double& a, double& b) {
            a = double(wi.z);
            b = (std::atan2(double(wi.y), double(wi.x)) + std::numbers::pi) /
                (2 * std::numbers::pi);
            return a >= 0.0 && a < 1.0 && b < 1.0;
          },
          [=](double a, double b) {
            const double phi = (2.0 * b - 1.0) * std::numbers::pi;
            const glm::vec3 wi = direction(float(a), float(phi));
            return 2.0 * std::numbers::pi * double(evaluate(bsdf, wo, wi).pdf);
          }};
}

/// Slopes of the half vector, in units of alpha: follows the lobe however narrow it is.
Chart slope_chart(const Bsdf& bsdf, glm::vec3 wo, double alpha) {
  constexpr double reach = 6.0;
  return {[=](glm::vec3 wi, double& a, double& b) {
            const glm::dvec3 m = glm::dvec3(wo) + glm::dvec3(wi);
            a = 0.5 + m.x / m.z / (2.0 * reach * alpha);
            b = 0.5 + m.y / m.z / (2.0 * reach * alpha);
            return a >= 0.0 && a < 1.0 && b >= 0.0 && b < 1.0;
          },
          [=](double a, double b) {
            const double p = (2.0 * a - 1.0) * reach * alpha;
            const double q = (2.0 * b - 1.0) * reach * alpha;
            const glm::dvec3 m = glm::normalize(glm::dvec3(p, q, 1.0));
            const double cosine = glm::dot(glm::dvec3(wo), m);
            const glm::dvec3 wi = 2.0 * cosine * m - glm::dvec3(wo);
            if (wi.z <= 0.0 || cosine <= 0.0) {
              return 0.0;
            }
            const double pdf = double(evaluate(bsdf, wo, glm::vec3(wi)).pdf);
            // dωi = 4 (wo·m) dωm, and dωm = cos³θm dp dq.
            return pdf * 4.0 * cosine * m.z * m.z * m.z * 4.0 * reach * reach * alpha * alpha;
          }};
}

TEST(Bsdf, SamplingFollowsTheDensity) {
  constexpr std::uint32_t count = 160000;
  struct Result {
    std::string name;
    ChiSquare chi_square;
  };
  std::vector<Result> results;
  for (const BsdfCase& c : bsdf_cases()) {
    const Bsdf bsdf = bsdf_of(c.material);
    if (is_specular(bsdf) || c.material.two_sided) {
      continue;  // no density, or the same one as without the other side
    }
    const RoughConductor* rough = std::get_if<RoughConductor>(&c.material.kind);
    if (rough && rough->metal.eta != glm::vec3(0.0f)) {
      continue;  // the colour changes no direction
    }
    for (const glm::vec3 wo : outgoing()) {
      const Chart chart =
          rough ? slope_chart(bsdf, wo, double(rough->alpha)) : spherical_chart(bsdf, wo);
      constexpr int bins = Chart::bins;
      constexpr int steps = Chart::steps;
      std::vector<double> expected(bins * bins + 1, 0.0);
      double total = 0.0;
      for (int i = 0; i < bins * steps; ++i) {
        for (int j = 0; j < bins * steps; ++j) {
          const double mass =
              chart.density((i + 0.5) / (bins * steps), (j + 0.5) / (bins * steps)) /
              (double(bins * steps) * double(bins * steps));
          expected[std::size_t((i / steps) * bins + j / steps)] += count * mass;
          total += mass;
        }
      }
      ASSERT_LE(total, 1.0 + 2e-4) << c.name << ": the density integrates to more than 1";
      if (!rough) {
        EXPECT_NEAR(total, 1.0, 2e-4) << c.name;
      }
      expected.back() = count * std::max(0.0, 1.0 - total);
      std::vector<double> observed(expected.size(), 0.0);
      for (const BsdfSample& s : samples_of(bsdf, wo, 4, count)) {
        double a = 0.0;
        double b = 0.0;
        const bool inside = s.weight != glm::vec3(0.0f) && chart.to_chart(s.wi, a, b);
        observed[inside ? std::size_t(a * bins) * bins + std::size_t(b * bins)
                        : expected.size() - 1] += 1.0;
      }
      results.push_back(
          {c.name + ", cos " + std::to_string(wo.z), chi_square_test(observed, expected)});
    }
  }
  EXPECT_GE(results.size(), 40u);
  const double level = sidak_level(1e-3, double(results.size()));  // false-alarm rate 1e-3
  for (const Result& r : results) {
    EXPECT_GE(r.chi_square.p, level) << r.name << ": " << r.chi_square.describe();
  }
}

TEST(Bsdf, TheChiSquareTestSeesAnErrorOfFivePercent) {
  // The same sampling against a lobe 5 % wider.
  const Material material = make(RoughConductor{{}, 0.2f});
  const Material wider = make(RoughConductor{{}, 0.2f * 1.05f});
  const glm::vec3 wo = direction(0.6f, 2.0f);
  const Chart chart = slope_chart(bsdf_of(wider), wo, 0.2);
  constexpr int bins = Chart::bins;
  constexpr double count = 160000;
  std::vector<double> expected(bins * bins + 1, 0.0);
  double total = 0.0;
  for (int i = 0; i < bins * bins; ++i) {
    for (int j = 0; j < bins * bins; ++j) {
      const double mass = chart.density((i + 0.5) / (bins * bins), (j + 0.5) / (bins * bins)) /
                          std::pow(double(bins), 4.0);
      expected[std::size_t((i / bins) * bins + j / bins)] += count * mass;
      total += mass;
    }
  }
  expected.back() = count * (1.0 - total);
  std::vector<double> observed(expected.size(), 0.0);
  for (const BsdfSample& s : samples_of(bsdf_of(material), wo, 4, std::uint32_t(count))) {
    double a = 0.0;
    double b = 0.0;
    const bool inside = s.weight != glm::vec3(0.0f) && chart.to_chart(s.wi, a, b);
    observed[inside ? std::size_t(a * bins) * bins + std::size_t(b * bins) : expected.size() - 1] +=
        1.0;
  }
  EXPECT_LT(chi_square_test(observed, expected).p, 1e-6);
}

}  // namespace
}  // namespace quartet
