#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "renderer/scene/scene.h"

namespace quartet {

/// One row of the table of distributions that stand in for tracing, so that truth is exact: every
/// sample of every pixel is drawn from it alone, the same in all three channels.
struct Synthetic {
  std::string_view id;     ///< "synthetic:ID" is its scene
  std::string_view label;  ///< for people, with its parameters
  double mean;             ///< exact, of the samples that a film accepts
  double variance;         ///< of the same; finite in all rows
  /// A sample from two independent numbers in (0, 1).
  float (*draw)(double u, double v);
};

std::span<const Synthetic> synthetics();
/// Throws std::invalid_argument that lists the legal ids.
const Synthetic& find_synthetic(std::string_view id);

/// Samples first, first + 1, … of pixel (x, y): independent draws, a pure function of the
/// arguments.
void draw_synthetic(const Synthetic& row, std::uint64_t seed, int x, int y, std::uint32_t first,
                    std::span<glm::vec3> radiance);

/// An empty scene whose samples are drawn from a distribution; "synthetic:ID" is its name, and its
/// path, which says where a scene comes from.
Scene synthetic_scene(const Synthetic& row);

/// Whether a scene of this name is one of those.
bool is_synthetic_name(std::string_view name);

/// What the samples of a scene are drawn from; null for a scene that is traced.
const Synthetic* synthetic_of(const Scene& scene);

}  // namespace quartet
