#pragma once

#include <optional>
#include <vector>

#include "renderer/trace/integrator.h"
#include "renderer/trace/path.h"

namespace quartet {

/// Light that a path found at a vertex by sampling a light.
struct DirectLight {
  LightSample light;
  BsdfValue bsdf;          ///< for the light's direction
  float weight;            ///< of the power heuristic
  glm::vec3 contribution;  ///< to the radiance of the sample
};

/// Light that a path ran into.
struct FoundLight {
  glm::vec3 radiance;      ///< of the surface, or of the environment
  float weight;            ///< of the power heuristic
  glm::vec3 contribution;  ///< to the radiance of the sample
};

/// One vertex of a path; the last one has no surface if the path left the scene.
struct PathVertex {
  std::optional<Surface> surface;
  float distance = 0.0f;  ///< from the vertex before
  glm::vec3 throughput;   ///< of the path up to here
  std::optional<FoundLight> emitted;
  bool light_sampled = false;         ///< a ray to a light was traced
  std::optional<DirectLight> direct;  ///< what it found, if nothing stood in the way
  std::optional<BsdfSample> scattered;
  glm::vec3 direction{0.0f};      ///< in which the path goes on, in the world
  std::optional<float> survival;  ///< probability of Russian roulette
};

/// One sample, vertex by vertex.
struct PathLog {
  std::vector<PathVertex> vertices;
  PathEnd end = PathEnd::escaped;
  glm::vec3 radiance{0.0f};  ///< linear
};

/// Traces sample `index` of pixel (x, y) as the integrator does, and writes down what happens.
PathLog log_path(const TraceScene& scene, const RenderSettings& settings, int x, int y,
                 std::uint32_t index);

}  // namespace quartet
