#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <glm/glm.hpp>

#include "renderer/scene/materials/fresnel.h"
#include "renderer/trace/bsdf.h"
#include "tests/trace/bsdf_cases.h"

// Reflectance and refraction of smooth surfaces against closed forms.

namespace quartet {
namespace {

using namespace test;

TEST(Fresnel, DielectricAtNormalIncidence) {
  for (const float n : {1.0f, 1.1f, 1.33f, 1.5046f, 2.4f}) {
    const float r = (n - 1.0f) / (n + 1.0f);
    float cos_t = 0.0f;
    EXPECT_NEAR(fresnel_dielectric(1.0f, n, cos_t), r * r, 1e-7f);
    EXPECT_EQ(cos_t, 1.0f);
    EXPECT_NEAR(fresnel_dielectric(1.0f, 1.0f / n, cos_t), r * r, 1e-7f);
  }
}

TEST(Fresnel, DielectricAtBrewstersAngleLosesOnePolarisation) {
  for (const float n : {1.33f, 1.5046f, 2.4f}) {
    const float cosine = 1.0f / std::sqrt(1.0f + n * n);  // tan θ = n
    const float perpendicular = (1.0f - n * n) / (1.0f + n * n);
    float cos_t = 0.0f;
    EXPECT_NEAR(fresnel_dielectric(cosine, n, cos_t), 0.5f * perpendicular * perpendicular, 1e-6f);
    EXPECT_NEAR(cos_t, n * cosine, 1e-6f);  // the two rays are at right angles
  }
}

TEST(Fresnel, DielectricObeysSnellAndReflectsTotallyBeyondTheCriticalAngle) {
  const float n = 1.5f;
  const float critical = std::sqrt(1.0f - 1.0f / (n * n));
  for (float cos_i = 0.01f; cos_i <= 1.0f; cos_i += 0.01f) {
    float cos_t = 0.0f;
    fresnel_dielectric(cos_i, n, cos_t);
    EXPECT_NEAR(1.0f - cos_i * cos_i, n * n * (1.0f - cos_t * cos_t), 1e-6f);
    const float inside = fresnel_dielectric(cos_i, 1.0f / n, cos_t);
    if (cos_i < critical - 1e-4f) {
      EXPECT_EQ(inside, 1.0f);
      EXPECT_EQ(cos_t, 0.0f);
    } else if (cos_i > critical + 1e-4f) {
      EXPECT_LT(inside, 1.0f);
      // Light takes the same way back: reflectance depends on the pair of angles only.
      float back = 0.0f;
      EXPECT_NEAR(fresnel_dielectric(cos_t, n, back), inside, 2e-5f);
      EXPECT_NEAR(back, cos_i, 1e-5f);
    }
  }
}

TEST(Fresnel, ConductorAgreesWithComplexArithmetic) {
  using Complex = std::complex<double>;
  for (float cosine = 0.02f; cosine < 1.0f; cosine += 0.07f) {
    const glm::vec3 r = fresnel_conductor(cosine, gold_eta, gold_k);
    for (int i = 0; i < 3; ++i) {
      const Complex index{gold_eta[i], gold_k[i]};
      const double c = double(cosine);
      const Complex t = std::sqrt(index * index - (1.0 - c * c));
      const double s = std::norm((c - t) / (c + t));
      const double p = std::norm((index * index * c - t) / (index * index * c + t));
      EXPECT_NEAR(r[i], 0.5 * (s + p), 2e-6);
    }
  }
  const glm::vec3 normal = fresnel_conductor(1.0f, gold_eta, gold_k);
  for (int i = 0; i < 3; ++i) {
    const float k2 = gold_k[i] * gold_k[i];
    const float minus = gold_eta[i] - 1.0f;
    const float plus = gold_eta[i] + 1.0f;
    EXPECT_NEAR(normal[i], (minus * minus + k2) / (plus * plus + k2), 1e-6f);
  }
}

TEST(Fresnel, AConductorWithoutRealIndexReflectsEverything) {
  for (float cosine = 0.0f; cosine <= 1.0f; cosine += 0.01f) {
    EXPECT_EQ(fresnel_conductor(cosine, glm::vec3(0.0f), glm::vec3(1.0f)), glm::vec3(1.0f))
        << cosine;
  }
}

TEST(Dielectric, ReflectsAsOftenAsFresnelSaysAndRestoresRadianceOnTheWayOut) {
  const Material material = make(Dielectric{.ior = 1.5f});
  const Bsdf bsdf = bsdf_of(material);
  for (const glm::vec3 wo : outgoing()) {
    float cos_t = 0.0f;
    const float reflectance = fresnel_dielectric(wo.z, 1.5f, cos_t);
    const BsdfSample mirrored = sample(bsdf, wo, reflectance * 0.999f, 0.0f);
    EXPECT_EQ(mirrored.wi, glm::vec3(-wo.x, -wo.y, wo.z));
    EXPECT_EQ(mirrored.weight, glm::vec3(1.0f));
    EXPECT_EQ(mirrored.eta_scale, 1.0f);
    const BsdfSample in = sample(bsdf, wo, reflectance * 1.001f, 0.0f);
    EXPECT_NEAR(in.wi.z, -cos_t, 1e-6f);
    EXPECT_NEAR(in.wi.x, -wo.x / 1.5f, 1e-6f);
    EXPECT_NEAR(in.weight.x, 1.0f / (1.5f * 1.5f), 1e-6f);
    // Out through the other side of a slab, in whose frame the way comes from below.
    const BsdfSample out = sample(bsdf, {-in.wi.x, -in.wi.y, in.wi.z}, 0.999f, 0.0f);
    EXPECT_LT(glm::length(out.wi - glm::vec3(-wo.x, -wo.y, wo.z)), 1e-5f);
    EXPECT_NEAR(in.weight.x * out.weight.x, 1.0f, 1e-6f);
    EXPECT_NEAR(in.eta_scale * out.eta_scale, 1.0f, 1e-6f);
  }
  // From inside beyond the critical angle nothing gets out, whatever the random number.
  const BsdfSample total = sample(bsdf, direction(-0.5f, 1.0f), 0.999999f, 0.0f);
  EXPECT_LT(total.wi.z, 0.0f);
  EXPECT_EQ(total.weight, glm::vec3(1.0f));
}

}  // namespace
}  // namespace quartet
