#include "app/run_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <charconv>
#include <cmath>

#include "app/commands.h"
#include "app/messages.h"
#include "app/number_check.h"
#include "app/shell_words.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

constexpr double gib = 1024.0 * 1024.0 * 1024.0;

/// A picture that cannot fit should be refused before an hour of work, not after.
void check_memory(const RenderSettings& settings, std::size_t lanes) {
  // A pixel of a lane (film with statistics, error, counts, plan) and of the store with a few
  // samples.
  constexpr double lane_bytes = 150.0;
  constexpr double store_bytes = 150.0;
  const double pixels = double(settings.width) * double(settings.height);
  const double needed = pixels * (lane_bytes * double(lanes) + store_bytes);
  const double available = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
  if (needed > available) {
    throw UsageError(fmt::format(
        "--size: {}x{} would take about {:.0f} GiB of memory, and this machine has {:.0f} GiB; "
        "choose a smaller size",
        settings.width, settings.height, needed / gib, available / gib));
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
  for (const glm::vec3 axis : {camera.right, camera.up, camera.forward}) {
    // Also false for numbers that are not finite.
    if (!(std::abs(glm::length(axis) - 1.0f) < 1e-3f)) {
      throw UsageError("--camera: right, up and forward must have length 1");
    }
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
    parameters[define.substr(0, equals)] = define.substr(equals + 1);
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
  const char* const end = text.data() + text.size();
  int width = 0;
  int height = 0;
  const auto [x, width_error] = std::from_chars(text.data(), end, width);
  bool good = width_error == std::errc() && x != end && *x == 'x';
  if (good) {
    const auto [stop, height_error] = std::from_chars(x + 1, end, height);
    good = height_error == std::errc() && stop == end;
  }
  if (!good || width < 1 || height < 1) {
    throw UsageError(fmt::format(
        "{}: '{}' is not a size; write width x height in pixels, such as 960x540", option, text));
  }
  return {width, height};
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
  command.add_option("--integrator", options.integrator, "How light is found: kajiya or mis")
      ->capture_default_str();
  command
      .add_option("--max-depth", options.max_depth,
                  "Longest path in segments, 2 is direct light; the scene's own if not given")
      ->check(CLI::Range(1, 1'000'000));
  command.add_option("--seed", options.seed, "Another seed, other random numbers")
      ->capture_default_str();
  command
      .add_option("--camera", options.camera,
                  "Another place for the camera: origin, right, up, forward, 3 numbers each; the "
                  "window writes it")
      ->delimiter(',')
      ->expected(12);
}

void add_threads_option(CLI::App& command, RunOptions& options) {
  command.add_option("--threads", options.threads, "0: one a processor")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
}

void add_seeds_option(CLI::App& command, std::uint32_t& seeds, std::uint32_t least) {
  command.add_option("--seeds", seeds, "Independent repetitions, each with the next seed")
      ->check(CLI::Range(least, 10'000u))
      ->capture_default_str();
}

void check_seeds(const RunOptions& options, std::uint32_t seeds) {
  if (options.seed > UINT64_MAX - seeds) {
    throw UsageError("--seed: so near the highest number there are not enough seeds after it");
  }
}

void add_run_options(CLI::App& command, RunOptions& options, const std::string& size_name) {
  add_scene_options(command, options, size_name);
  add_threads_option(command, options);
  command.add_option("--memory", options.memory_gib, "For stored samples, in GiB")
      ->check(number_between(0.001, 1e6))
      ->capture_default_str();
  command.add_option("--policy", options.policy,
                     "How errors become sample counts: vote, two-level, batch or converge; the "
                     "estimator's own if not given");
  command
      .add_option(
          "--mode", options.mode,
          "reuse: the samples that decide are the picture, which is biased; unbiased: those "
          "of a pilot run decide")
      ->capture_default_str();
  command
      .add_option("--first-samples", options.first_samples,
                  "two-level, batch, converge: samples before the first look; 0: the policy's own")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      .add_option("--batch-samples", options.batch_samples,
                  "two-level, batch, converge: samples from one look to the next; 0: the policy's "
                  "own")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      .add_option("--multiplier", options.multiplier,
                  "vote: extra samples for each vote; 1 is the text of the 2021 report, 0.5 its "
                  "pictures")
      ->check(number_between(0.0, 1000.0))
      ->capture_default_str();
  command.add_flag("--stochastic-rounding", options.stochastic_rounding,
                   "vote: round multiplier x votes at random instead of down");
  command.add_option("--max-spp", options.max_spp, "No pixel gets more samples than this")
      ->check(CLI::Range(1u, 1u << 31))
      ->capture_default_str();
}

Run prepare_run(const RunOptions& options, std::size_t lanes) {
  const IntegratorId integrator = find_integrator(options.integrator).key;
  Scene scene = open_scene(options.scene, parse_defines(options.defines));
  for (const std::string& warning : scene.warnings) {
    warn("{}", warning);
  }
  Run run;
  run.settings = default_settings(scene);
  run.settings.integrator = integrator;
  run.settings.seed = options.seed;
  if (options.max_depth) {
    run.settings.max_depth = *options.max_depth;
  }
  if (!options.size.empty()) {
    const PictureSize size = parse_size(options.size_name, options.size);
    run.settings.width = size.width;
    run.settings.height = size.height;
  }
  if (!options.camera.empty()) {
    set_camera(options.camera, run.settings.camera);
  }
  check_memory(run.settings, lanes);
  run.lab.threads = options.threads;
  run.lab.memory = std::size_t(options.memory_gib * gib);
  run.lab.statistics.variance = true;
  run.scene = std::make_shared<const TraceScene>(std::move(scene));
  run.lab.pilot_source = pilot_source(run.scene, run.settings);
  return run;
}

SamplingPolicy policy_of(const RunOptions& options, EstimatorId estimator) {
  SamplingPolicy policy = default_policy(estimator);
  if (!options.policy.empty()) {
    policy.allocation.kind = find_allocation(options.policy).key;
  }
  policy.use = find_sample_use(options.mode).key;
  policy.allocation.first = options.first_samples;
  policy.allocation.batch = options.batch_samples;
  policy.allocation.multiplier = options.multiplier;
  policy.allocation.stochastic_rounding = options.stochastic_rounding;
  policy.max_spp = options.max_spp;
  return policy;
}

void tell_if_partial(const Lab& lab, const RunOptions& options) {
  if (lab.partial()) {
    tell(
        "the samples outgrew --memory ({} GiB): the oldest were forgotten, and a replay would "
        "trace "
        "them again",
        options.memory_gib);
  }
}

}  // namespace quartet
