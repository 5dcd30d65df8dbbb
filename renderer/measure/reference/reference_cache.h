#pragma once

#include <filesystem>

#include "renderer/scene/scene.h"
#include "renderer/trace/integrator.h"

namespace quartet {

/// Where this program's references wait to be used again: "quartet/references" under
/// $XDG_CACHE_HOME, or under ~/.cache. Empty if there is neither.
std::filesystem::path reference_cache_folder();

/// The file in a folder that holds the reference of a scene and settings: another for everything
/// that its samples depend on but the seed, which is reference_seed in all of them. Window and
/// command line find each other's.
std::filesystem::path cached_reference_path(const std::filesystem::path& folder, const Scene& scene,
                                            const RenderSettings& settings);

}  // namespace quartet
