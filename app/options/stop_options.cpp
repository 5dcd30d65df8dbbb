#include "app/options/stop_options.h"

#include <fmt/format.h>

#include "app/options/number_option.h"
#include "app/options/usage_error.h"
#include "renderer/scene/synthetic.h"

namespace quartet {

void add_stop_options(CLI::App& command, StopOptions& options) {
  add_number(command, "--passes,--frames", options.passes, {1, 1u << 31},
             "Stop after so many passes; 15 if no other end is given");
  add_number(command, "--spp", options.spp, spp_range, "Stop at this mean of samples per pixel");
  add_number(command, "--rays", options.rays, above_zero<double>,
             "Stop at this mean of rays per pixel: an effort that is the same on every machine");
  add_number(command, "--seconds", options.seconds, above_zero<double>,
             "Stop after so much time, as if the lane had run alone");
  command
      .add_option("--error", options.error,
                  "Stop at this error against --reference, such as relmse=0.01; metrics: quartet "
                  "list")
      ->type_name("METRIC=VALUE");
}

StopConditions stop_conditions(const StopOptions& options, bool has_reference) {
  StopConditions stop{options.passes, options.spp, options.rays, options.seconds, {}};
  if (!options.error.empty()) {
    try {
      stop.error = parse_error_target(options.error);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--error: {}", error.what()));
    }
    if (!has_reference) {
      throw UsageError(
          "--error needs --reference REF.exr to measure the error; quartet reference makes one");
    }
  }
  return stop;
}

void check_rays(const StopConditions& stop, const Scene& scene) {
  if (stop.rays && synthetic_of(scene) != nullptr) {
    throw UsageError(fmt::format(
        "--rays has no effect: the samples of {} are drawn, not traced; --spp counts them",
        scene.name));
  }
}

StopConditions or_passes(StopConditions stop) {
  if (!stop.any()) {
    stop.passes = 15;
  }
  return stop;
}

}  // namespace quartet
