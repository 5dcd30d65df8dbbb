#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/lane_settings_options.h"
#include "app/options/number_option.h"
#include "renderer/adaptive/lab.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/integrator.h"

namespace quartet {

/// The options that every rendering command has, as given.
struct RunOptions {
  std::string scene = "cornell-checker";
  std::vector<std::string> defines;
  std::string size;
  std::string size_name = "--size";
  std::string integrator;  ///< empty: mis
  std::string sampler;     ///< empty: that of default_settings()
  std::optional<int> max_depth;
  std::uint64_t seed = 0;
  std::vector<float> camera;
  int threads = 0;
  double memory_gib = 2.0;
  LaneSettingsOptions lane_settings;
};

/// Adds those that decide the value of a sample: scene, parameters, size, integrator, sampler,
/// depth, seed, camera.
void add_scene_options(CLI::App& command, RunOptions& options,
                       const std::string& size_name = "--size");

void add_sampler_option(CLI::App& command, std::string& sampler);
void add_threads_option(CLI::App& command, RunOptions& options);
void add_memory_option(CLI::App& command, RunOptions& options);

/// As many as --threads says. No more than this machine runs at once, which a line on stderr says
/// then.
int usable_threads(const RunOptions& options);

/// Of intervals that shall hold all together.
inline constexpr NumberRange<double> confidence_range{0.5, 0.999999};

/// Adds --seeds, how many times a command repeats its runs, each time with the next seed.
void add_seeds_option(CLI::App& command, std::uint32_t& seeds, std::uint32_t least = 1);
/// Throws UsageError if there are not so many seeds from the first one on.
void check_seeds(const RunOptions& options, std::uint32_t seeds);

/// Adds all of them to a command; `size_name` is what the picture size is called where --size is
/// something else.
void add_run_options(CLI::App& command, RunOptions& options,
                     const std::string& size_name = "--size");

/// "name=value" words as parameters of a scene file. Throws UsageError.
SceneParameters parse_defines(const std::vector<std::string>& defines);

/// The options of add_scene_options that are not at their defaults, the scene first, as words of a
/// command line.
std::string scene_words(const RunOptions& options);

struct PictureSize {
  int width, height;
};
/// A side of a picture, in pixels.
inline constexpr int most_picture_side = 1 << 24;
/// "960x540"; throws UsageError that begins with the option's name.
PictureSize parse_size(const std::string& option, const std::string& text);

/// What to render.
struct Run {
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  LabOptions lab;
};

/// Loads the scene, whose warnings go to stderr, and reads the options. `lanes` is how many will
/// run, for an early look at the memory. Throws UsageError or SceneError.
Run prepare_run(const RunOptions& options, std::size_t lanes);

/// A line on stderr if samples were forgotten for want of memory, so that a store is `partial`.
void tell_if_partial(bool partial, const RunOptions& options);

}  // namespace quartet
