#include "renderer/measure/reference/reference_cache.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "renderer/scene/scene_hash.h"

namespace quartet {
namespace {

/// FNV-1a, 64 bits: like the scene's hash it only keeps one user's files apart.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  return hash;
}

std::string vector_text(glm::vec3 v) {
  return fmt::format("{:a},{:a},{:a}", v.x, v.y, v.z);
}

std::string camera_text(const Camera& camera) {
  return fmt::format("{} {} {} {} {:a} {} {:a} {:a}", vector_text(camera.origin),
                     vector_text(camera.right), vector_text(camera.up), vector_text(camera.forward),
                     camera.fov, int(camera.fov_axis), camera.aperture_radius,
                     camera.focus_distance);
}

}  // namespace

std::filesystem::path reference_cache_folder() {
  const auto folder = [](const char* variable) -> std::filesystem::path {
    const char* const value = std::getenv(variable);
    return value && *value ? value : "";
  };
  std::filesystem::path base = folder("XDG_CACHE_HOME");
  if (base.empty() && !folder("HOME").empty()) {
    base = folder("HOME") / ".cache";
  }
  return base.empty() ? base : base / "quartet" / "references";
}

std::filesystem::path cached_reference_path(const std::filesystem::path& folder, const Scene& scene,
                                            const RenderSettings& settings) {
  std::string key = fmt::format("{} {} {} {}", scene_hash(scene), camera_text(settings.camera),
                                settings.max_depth, integrator(settings.integrator).id);
  // That of sobol is as it was before there were others, and what was cached then still fits.
  if (settings.sampler != SamplerId::sobol) {
    key += fmt::format(" {}", sampler_row(settings.sampler).id);
  }
  return folder / fmt::format("{}-{}x{}-{:016x}.exr", scene.name, settings.width, settings.height,
                              hash_of(key));
}

}  // namespace quartet
