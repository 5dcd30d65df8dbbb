#include "app/options/run_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/options/number_option.h"
#include "app/options/usage_error.h"
#include "app/terminal/messages.h"
#include "app/terminal/shell_words.h"
#include "renderer/adaptive/memory_need.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr double gib = 1024.0 * 1024.0 * 1024.0;

/// A picture that cannot fit should be refused before an hour of work, not after.
void check_memory(const RenderSettings& settings, std::size_t lanes, const std::string& size_name) {
  if (const std::string refusal = memory_refusal(settings.width, settings.height, lanes);
      !refusal.empty()) {
    throw UsageError(fmt::format("{}: {}", size_name, refusal));
  }
}

void set_camera(const std::vector<float>& numbers, Camera& camera) {
  const auto vector = [&](std::size_t first) {
    return glm::vec3(numbers[first], numbers[first + 1], numbers[first + 2]);
  };
  camera.origin = vector(0);
  camera.right = vector(3);
  camera.up = vector(6);
  camera.forward = vector(9);
  if (const std::string fault = camera_fault(camera); !fault.empty()) {
    throw UsageError("--camera: " + fault);
  }
}

/// What stands in for a scene draws its samples, and has neither paths nor a camera.
void check_traced(const RunOptions& options, const Scene& scene) {
  if (synthetic_of(scene) == nullptr) {
    return;
  }
  const std::string_view given = !options.integrator.empty() ? "--integrator"
                                 : !options.sampler.empty()  ? "--sampler"
                                 : options.max_depth         ? "--max-depth"
                                 : !options.camera.empty()   ? "--camera"
                                                             : "";
  if (!given.empty()) {
    throw UsageError(fmt::format(
        "{} has no effect: it is for scenes whose light is traced, and {} draws its samples", given,
        scene.name));
  }
}

}  // namespace

SceneParameters parse_defines(const std::vector<std::string>& defines) {
  SceneParameters parameters;
  for (const std::string& define : defines) {
    const std::size_t equals = define.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError(fmt::format("-D: '{}' is not a parameter; write name=value", define));
    }
    const std::string name = define.substr(0, equals);
    if (!parameters.emplace(name, define.substr(equals + 1)).second) {
      throw UsageError(fmt::format("-D: '{}' is given twice; give each parameter once", name));
    }
  }
  return parameters;
}

std::string scene_words(const RunOptions& options) {
  const RunOptions plain;
  std::string words = shell_word(options.scene);
  for (const std::string& define : options.defines) {
    words += " -D " + shell_word(define);
  }
  if (!options.size.empty()) {
    words += " --size " + shell_word(options.size);
  }
  if (options.integrator != plain.integrator) {
    words += " --integrator " + shell_word(options.integrator);
  }
  if (options.sampler != plain.sampler) {
    words += " --sampler " + shell_word(options.sampler);
  }
  if (options.max_depth) {
    words += fmt::format(" --max-depth {}", *options.max_depth);
  }
  if (options.seed != plain.seed) {
    words += fmt::format(" --seed {}", options.seed);
  }
  if (!options.camera.empty()) {
    words += fmt::format(" --camera={}", fmt::join(options.camera, ","));
  }
  return words;
}

PictureSize parse_size(const std::string& option, const std::string& text) {
  constexpr NumberRange<int> side{1, most_picture_side};
  const std::size_t x = text.find('x');
  const auto width = number_in(std::string_view(text).substr(0, x), side);
  const auto height =
      number_in(x == std::string::npos ? "" : std::string_view(text).substr(x + 1), side);
  if (!width || !height) {
    throw UsageError(fmt::format(
        "{}: '{}' is not a size; write width x height in pixels, each from {}, such as 960x540",
        option, text, range_text(side)));
  }
  return {*width, *height};
}

void add_scene_options(CLI::App& command, RunOptions& options, const std::string& size_name) {
  options.size_name = size_name;
  command
      .add_option("scene", options.scene,
                  "A Mitsuba 3 XML file, the name of a built-in scene, or synthetic:ID")
      ->required();
  command.add_option("-D", options.defines, "A parameter of the scene file: name=value")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option(size_name, options.size, "Picture size; the scene's own if not given")
      ->type_name("WxH");
  command.add_option("--integrator", options.integrator,
                     "How light is found: kajiya or mis, the default");
  add_sampler_option(command, options.sampler);
  add_number(command, "--max-depth", options.max_depth, {1, 1'000'000},
             "Longest path in segments, 2 is direct light; the scene's own if not given");
  add_number(command, "--seed", options.seed, {0, std::numeric_limits<std::uint64_t>::max()},
             "Another seed, other random numbers");
  constexpr float most = std::numeric_limits<float>::max();
  add_numbers(command, "--camera", options.camera, {-most, most},
              "Another place for the camera: origin, right, up, forward, 3 numbers each; the "
              "window writes it")
      ->expected(12);
}

void add_sampler_option(CLI::App& command, std::string& sampler) {
  command.add_option("--sampler", sampler,
                     "Where random numbers come from: sobol, the default, independent or "
                     "replicated; see quartet list");
}

void add_threads_option(CLI::App& command, RunOptions& options) {
  add_number(command, "--threads", options.threads, {0, 4096}, "0: one a processor");
}

void add_memory_option(CLI::App& command, RunOptions& options) {
  add_number(command, "--memory", options.memory_gib, {0.001, 1e6}, "For stored samples, in GiB");
}

int usable_threads(const RunOptions& options) {
  const int most = tbb::this_task_arena::max_concurrency();
  if (options.threads > most) {
    tell("--threads {}: this machine runs {} at once, and no more are used", options.threads, most);
  }
  return std::min(options.threads, most);
}

void add_seeds_option(CLI::App& command, std::uint32_t& seeds, std::uint32_t least) {
  add_number(command, "--seeds", seeds, {least, 10'000},
             "Independent repetitions, each with the next seed");
}

void check_seeds(const RunOptions& options, std::uint32_t seeds) {
  if (options.seed > UINT64_MAX - seeds) {
    throw UsageError("--seed: so near the highest number there are not enough seeds after it");
  }
}

void add_run_options(CLI::App& command, RunOptions& options, const std::string& size_name) {
  add_scene_options(command, options, size_name);
  add_threads_option(command, options);
  add_memory_option(command, options);
  add_lane_settings_options(command, options.lane_settings);
}

Run prepare_run(const RunOptions& options, std::size_t lanes) {
  const IntegratorId integrator = options.integrator.empty()
                                      ? RenderSettings().integrator
                                      : find_integrator(options.integrator).key;
  std::optional<SamplerId> sampler;
  if (!options.sampler.empty()) {
    sampler = find_sampler(options.sampler).key;
  }
  Scene scene = open_scene(options.scene, parse_defines(options.defines));
  check_integrator(scene, integrator);
  for (const std::string& warning : scene.warnings) {
    warn("{}", warning);
  }
  check_traced(options, scene);
  Run run;
  run.settings = default_settings(scene);
  run.settings.integrator = integrator;
  run.settings.sampler = sampler.value_or(run.settings.sampler);
  run.settings.seed = options.seed;
  if (options.max_depth) {
    run.settings.max_depth = *options.max_depth;
  }
  if (!options.size.empty()) {
    const PictureSize size = parse_size(options.size_name, options.size);
    run.settings.width = size.width;
    run.settings.height = size.height;
    if (const std::string fault = picture_size_fault(size.width, size.height); !fault.empty()) {
      throw UsageError(fmt::format("{}: {}", options.size_name, fault));
    }
  }
  if (!options.camera.empty()) {
    set_camera(options.camera, run.settings.camera);
  }
  check_memory(run.settings, lanes, options.size_name);
  run.lab.threads = usable_threads(options);
  run.lab.memory = std::size_t(options.memory_gib * gib);
  run.lab.statistics.variance = true;
  run.lab.sampler = run.settings.sampler;
  run.scene = std::make_shared<const TraceScene>(std::move(scene));
  run.lab.pilot_source = pilot_source(run.scene, run.settings);
  return run;
}

void tell_if_partial(bool partial, const RunOptions& options) {
  if (partial) {
    tell(
        "the samples outgrew --memory ({} GiB): some were forgotten, and are traced again where "
        "they "
        "are needed",
        options.memory_gib);
  }
}

}  // namespace quartet
