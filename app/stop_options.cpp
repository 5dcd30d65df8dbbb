#include "app/stop_options.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "app/number_check.h"

namespace quartet {

void add_stop_options(CLI::App& command, StopOptions& options) {
  command
      .add_option("--frames", options.frames,
                  "Stop after so many rounds of sampling; 15 if no other end is given")
      ->check(CLI::Range(1u, 1u << 31));
  command.add_option("--spp", options.spp, "Stop at this mean of samples per pixel")
      ->check(number_above_zero());
  command
      .add_option("--seconds", options.seconds,
                  "Stop after so much time, as if the lane had run alone")
      ->check(number_above_zero());
  command
      .add_option("--error", options.error,
                  "Stop at this error against --reference, such as relmse=0.01; metrics: quartet "
                  "list")
      ->type_name("METRIC=VALUE");
}

StopConditions stop_conditions(const StopOptions& options, bool has_reference) {
  StopConditions stop{options.frames, options.spp, options.seconds, {}};
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
  if (!stop.any()) {
    stop.frames = 15;
  }
  return stop;
}

}  // namespace quartet
