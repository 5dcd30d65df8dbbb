#include "renderer/trace/bsdf.h"

#include "renderer/trace/color_at.h"

namespace quartet {
namespace {

/// GGX normal distribution: Walter et al., "Microfacet Models for Refraction through Rough
/// Surfaces", EGSR 2007, eq. 33. The squared sine of the angle comes from x and y, because 1 − cos²
/// keeps no digits where alpha is small.
float ggx_distribution(glm::vec3 m, float alpha) {
  const float a2 = alpha * alpha;
  const float d = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
  return a2 / (pi * d * d);
}

/// Smith masking for GGX, ibid. eq. 34. The product over both directions, as Mitsuba takes it, is
/// what makes public scenes look alike; the height-correlated form would be slightly brighter.
float ggx_masking(glm::vec3 w, float alpha) {
  const float tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 2.0f / (1.0f + std::sqrt(1.0f + alpha * alpha * tan2));
}

/// A normal visible from `wo` (in the upper hemisphere): Heitz, "Sampling the GGX Distribution of
/// Visible Normals", JCGT 7(4), 2018.
glm::vec3 sample_visible_normal(glm::vec3 wo, float alpha, float u, float v) {
  const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * wo.x, alpha * wo.y, wo.z));
  glm::vec2 p = square_to_disk(u, v);
  const float across2 = stretched.x * stretched.x + stretched.y * stretched.y;
  const glm::vec3 t1 = across2 > 0.0f
                           ? glm::vec3(-stretched.y, stretched.x, 0.0f) / std::sqrt(across2)
                           : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 t2 = glm::cross(stretched, t1);
  const float s = 0.5f * (1.0f + stretched.z);
  p.y = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p.x * p.x)) + s * p.y;
  const glm::vec3 n =
      p.x * t1 + p.y * t2 + std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y)) * stretched;
  return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
}

glm::vec3 conductor_fresnel(const Bsdf& bsdf, float cos_i) {
  return bsdf.reflectance * fresnel_conductor(cos_i, bsdf.material->eta, bsdf.material->k);
}

BsdfValue evaluate_rough_conductor(const Bsdf& bsdf, glm::vec3 wo, glm::vec3 wi) {
  const float alpha = bsdf.material->alpha;
  const glm::vec3 m = glm::normalize(wo + wi);
  const float d_g1 = ggx_distribution(m, alpha) * ggx_masking(wo, alpha);
  const glm::vec3 fresnel = conductor_fresnel(bsdf, glm::dot(wo, m));
  BsdfValue value;
  value.f_cos = fresnel * (d_g1 * ggx_masking(wi, alpha) / (4.0f * wo.z));
  value.pdf = d_g1 / (4.0f * wo.z);
  return value;
}

BsdfSample sample_dielectric(const Bsdf& bsdf, glm::vec3 wo, float u) {
  BsdfSample s;
  s.specular = true;
  const float cos_i = std::abs(wo.z);
  if (cos_i == 0.0f) {
    return s;
  }
  const float ior = bsdf.material->ior;
  const float eta = wo.z > 0.0f ? ior : 1.0f / ior;
  float cos_t = 0.0f;
  const float reflectance = fresnel_dielectric(cos_i, eta, cos_t);
  if (u < reflectance) {
    s.wi = {-wo.x, -wo.y, wo.z};
    s.weight = bsdf.reflectance;
    return s;
  }
  s.wi = {-wo.x / eta, -wo.y / eta, wo.z > 0.0f ? -cos_t : cos_t};
  // Radiance shrinks with the square of the index when it leaves the denser side (Veach 1997,
  // section 5.2); the path runs against the light.
  s.weight = bsdf.transmittance / (eta * eta);
  s.eta_scale = eta * eta;
  return s;
}

}  // namespace

Bsdf bsdf_at(const Scene& scene, const Material& material, glm::vec2 uv) {
  return {material.kind, material.two_sided, color_at(scene, material.reflectance, uv),
          color_at(scene, material.transmittance, uv), &material};
}

BsdfValue evaluate(const Bsdf& bsdf, glm::vec3 wo, glm::vec3 wi) {
  if (is_specular(bsdf) || wo.z * wi.z <= 0.0f || (wo.z < 0.0f && !bsdf.two_sided)) {
    return {};
  }
  if (wo.z < 0.0f) {
    wo.z = -wo.z;
    wi.z = -wi.z;
  }
  if (bsdf.kind == MaterialKind::rough_conductor) {
    return evaluate_rough_conductor(bsdf, wo, wi);
  }
  const float pdf = wi.z * (1.0f / pi);
  return {bsdf.reflectance * pdf, pdf};
}

BsdfSample sample(const Bsdf& bsdf, glm::vec3 wo, float u, float v) {
  if (bsdf.kind == MaterialKind::dielectric) {
    return sample_dielectric(bsdf, wo, u);
  }
  BsdfSample s;
  const bool below = wo.z < 0.0f;
  if (wo.z == 0.0f || (below && !bsdf.two_sided)) {
    return s;
  }
  wo.z = std::abs(wo.z);
  switch (bsdf.kind) {
    case MaterialKind::diffuse:
      s.wi = square_to_cosine_hemisphere(u, v);
      s.pdf = s.wi.z * (1.0f / pi);
      s.weight = s.pdf > 0.0f ? bsdf.reflectance : glm::vec3(0.0f);
      break;
    case MaterialKind::conductor:
      s.wi = {-wo.x, -wo.y, wo.z};
      s.weight = conductor_fresnel(bsdf, wo.z);
      s.specular = true;
      break;
    case MaterialKind::rough_conductor: {
      const glm::vec3 m = sample_visible_normal(wo, bsdf.material->alpha, u, v);
      s.wi = 2.0f * glm::dot(wo, m) * m - wo;
      if (s.wi.z <= 0.0f) {
        return s;
      }
      const BsdfValue value = evaluate_rough_conductor(bsdf, wo, s.wi);
      s.pdf = value.pdf;
      s.weight = value.pdf > 0.0f ? value.f_cos / value.pdf : glm::vec3(0.0f);
      break;
    }
    case MaterialKind::dielectric:
      break;
  }
  if (below) {
    s.wi.z = -s.wi.z;
  }
  return s;
}

float fresnel_dielectric(float cos_i, float eta, float& cos_t) {
  const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0f) {
    cos_t = 0.0f;
    return 1.0f;
  }
  cos_t = std::sqrt(1.0f - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

glm::vec3 fresnel_conductor(float cos_i, glm::vec3 eta, glm::vec3 k) {
  // Born and Wolf, "Principles of Optics", section 14.2, without complex numbers.
  const float cos2 = cos_i * cos_i;
  const float sin2 = 1.0f - cos2;
  const glm::vec3 t0 = eta * eta - k * k - sin2;
  const glm::vec3 a2_plus_b2 = glm::sqrt(t0 * t0 + 4.0f * eta * eta * k * k);
  const glm::vec3 a = glm::sqrt(glm::max(glm::vec3(0.0f), 0.5f * (a2_plus_b2 + t0)));
  const glm::vec3 t1 = a2_plus_b2 + cos2;
  const glm::vec3 t2 = 2.0f * cos_i * a;
  const glm::vec3 perpendicular = (t1 - t2) / (t1 + t2);
  const glm::vec3 t3 = cos2 * a2_plus_b2 + sin2 * sin2;
  const glm::vec3 t4 = t2 * sin2;
  const glm::vec3 parallel = perpendicular * (t3 - t4) / (t3 + t4);
  return 0.5f * (parallel + perpendicular);
}

}  // namespace quartet
