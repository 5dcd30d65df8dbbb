#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
  std::string integrator = "mis";
  std::optional<int> max_depth;
  std::uint64_t seed = 0;
  std::vector<float> camera;
  int threads = 0;
  double memory_gib = 2.0;
  std::string policy;  ///< empty: the estimator's own
  std::string mode = "reuse";
  std::uint16_t first_samples = 0;
  std::uint16_t batch_samples = 0;
  float multiplier = 0.5f;
  bool stochastic_rounding = false;
  std::uint32_t max_spp = SamplingPolicy{}.max_spp;
};

/// Adds those that decide the value of a sample: scene, parameters, size, integrator, depth, seed,
/// camera.
void add_scene_options(CLI::App& command, RunOptions& options,
                       const std::string& size_name = "--size");

void add_threads_option(CLI::App& command, RunOptions& options);

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

/// The policy that the options ask of an estimator, with its default thresholds.
SamplingPolicy policy_of(const RunOptions& options, EstimatorId estimator);

/// A line on stderr if samples were forgotten for want of memory.
void tell_if_partial(const Lab& lab, const RunOptions& options);

}  // namespace quartet
