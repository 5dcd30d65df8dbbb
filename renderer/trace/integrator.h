#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "renderer/trace/camera_rays.h"
#include "renderer/trace/sampler_row.h"
#include "renderer/trace/store/sample_source.h"
#include "renderer/trace/trace_scene.h"

namespace quartet {

enum class IntegratorId { kajiya, mis };

/// Everything that decides the value of a sample, beside the scene. A change makes other samples,
/// so it empties the store.
struct RenderSettings {
  Camera camera;
  int width = 0;
  int height = 0;
  int max_depth = std::numeric_limits<int>::max();  ///< segments of a path
  IntegratorId integrator = IntegratorId::mis;
  SamplerId sampler = SamplerId::sobol;
  std::uint64_t seed = 0;
  /// Whether paths may end by Russian roulette. Without it they go on to max_depth, which should
  /// then not be without limit: between perfect mirrors nothing else ends them.
  bool roulette = true;
  bool operator==(const RenderSettings&) const = default;
};

/// The sampler that is used where this one is asked for: what stands in for a scene draws
/// independent samples, and knows no other.
SamplerId sampler_for(const Scene& scene, SamplerId asked);

/// The settings that a scene file asks for.
RenderSettings default_settings(const Scene& scene);

/// One row of the table of integrators.
struct Integrator {
  IntegratorId key;
  std::string_view id;     ///< on the command line and in files
  std::string_view label;  ///< for people
  std::string_view description;
  bool finds_points;  ///< light that no ray meets by chance
  /// Makes what the jobs ask for; their work is in rays.
  void (*trace_jobs)(const TraceScene& scene, const RenderSettings& settings,
                     const CameraRays& camera, std::span<SampleJob> jobs);

  /// Writes the radiance of samples first, first + 1, … of pixel (x, y), counted from the top left.
  void trace(const TraceScene& scene, const RenderSettings& settings, const CameraRays& camera,
             int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) const {
    SampleJob job{x, y, first, radiance};
    trace_jobs(scene, settings, camera, {&job, 1});
  }
};

/// Why an integrator cannot render a scene: it would miss light, and the picture, truth or not,
/// would be too dark without a word. Empty if it can.
std::string why_not(const Scene& scene, IntegratorId key);
/// Throws std::invalid_argument that says so. Whoever prepares a run calls it early; where samples
/// begin (sample_source) it is called in any case.
void check_integrator(const Scene& scene, IntegratorId key);

std::span<const Integrator> integrators();
const Integrator& integrator(IntegratorId key);
/// Throws std::invalid_argument that lists the legal ids.
const Integrator& find_integrator(std::string_view id);

}  // namespace quartet
