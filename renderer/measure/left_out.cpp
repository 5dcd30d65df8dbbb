#include "renderer/measure/left_out.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace quartet {
namespace {

bool is_finite_pixel(glm::vec3 c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

LeftOut checked_left_out(const RadianceImage& test, const RadianceImage& reference) {
  require_same_size(test, reference);
  LeftOut left_out = left_out_of(test, reference);
  if (left_out.either == test.size()) {
    throw std::invalid_argument("no pixel is finite in both pictures; one at least would be right");
  }
  return left_out;
}

/// The pixels that are not left out, one after the other.
RadianceImage kept_pixels(const RadianceImage& image, const LeftOut& left_out) {
  RadianceImage kept(int(image.size() - left_out.either), 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (left_out.is_left_out[i] == 0) {
      kept.pixels()[count++] = image.pixels()[i];
    }
  }
  return kept;
}

RadianceImage blackened(RadianceImage image, const LeftOut& left_out) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (left_out.is_left_out[i] != 0) {
      image.pixels()[i] = glm::vec3(0.0f);
    }
  }
  return image;
}

ScalarImage kept_map(const Metric& metric, const RadianceImage& test,
                     const RadianceImage& reference, const LeftOut& left_out) {
  ScalarImage map = metric.map(blackened(test, left_out), blackened(reference, left_out));
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (left_out.is_left_out[i] != 0) {
      map.pixels()[i] = 0.0f;
    }
  }
  return map;
}

}  // namespace

LeftOut left_out_of(const RadianceImage& test, const RadianceImage& reference) {
  LeftOut result;
  result.is_left_out.resize(test.size());
  for (std::size_t i = 0; i < test.size(); ++i) {
    const bool in_test = is_finite_pixel(test.pixels()[i]);
    const bool in_reference = is_finite_pixel(reference.pixels()[i]);
    result.test += in_test ? 0 : 1;
    result.reference += in_reference ? 0 : 1;
    if (!in_test || !in_reference) {
      result.is_left_out[i] = 1;
      ++result.either;
    }
  }
  return result;
}

double compute_over_finite(const Metric& metric, const RadianceImage& test,
                           const RadianceImage& reference) {
  const LeftOut left_out = checked_left_out(test, reference);
  if (left_out.either == 0) {
    return metric.compute(test, reference);
  }
  if (!metric.looks_around) {
    return metric.compute(kept_pixels(test, left_out), kept_pixels(reference, left_out));
  }
  const ScalarImage map = kept_map(metric, test, reference, left_out);
  double sum = 0.0;
  for (const float value : map.pixels()) {
    sum += value;
  }
  return sum / double(test.size() - left_out.either);
}

ScalarImage map_over_finite(const Metric& metric, const RadianceImage& test,
                            const RadianceImage& reference) {
  const LeftOut left_out = checked_left_out(test, reference);
  return left_out.either == 0 ? metric.map(test, reference)
                              : kept_map(metric, test, reference, left_out);
}

}  // namespace quartet
