#include "app/options/lane_settings_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "app/options/add_once.h"
#include "app/options/usage_error.h"
#include "renderer/adaptive/estimators/estimator.h"

namespace quartet {
namespace {

constexpr NumberRange<std::uint32_t> max_spp_range{1, most_spp};

/// "two-level, batch, converge": those that read a parameter.
std::string policies_reading(PolicyParameterId parameter) {
  std::string ids;
  for (const PolicyRow& row : policies()) {
    if (reads(row, parameter)) {
      ids += fmt::format("{}{}", ids.empty() ? "" : ", ", row.id);
    }
  }
  return ids;
}

/// "vote, two-level, batch or converge".
std::string any_policy() {
  std::string ids;
  for (const PolicyRow& row : policies()) {
    const bool last = &row == &policies().back();
    ids += fmt::format("{}{}", ids.empty() ? "" : last ? " or " : ", ", row.id);
  }
  return ids;
}

bool always(const LaneSettings&) {
  return true;
}

LaneWord policy_word() {
  return {
      .option = "--policy",
      .word = "policy",
      .value = "P",
      .readers = "it is for estimators of errors",
      .given = [](const LaneSettingsOptions& options) { return !options.policy.empty(); },
      .read_by =
          [](const LaneSettings& settings) { return estimator(settings.estimator).channels > 0; },
      .put = [](const LaneSettingsOptions& options,
                LaneSettings& settings) { settings.policy.kind = find_policy(options.policy).key; },
      .read =
          [](const std::string& value, LaneSettingsOptions& options) {
            options.policy = find_policy(value).id;
            return std::string();
          },
      .said_of = [](const LaneSettings& settings) -> std::optional<std::string> {
        if (settings.policy.kind == estimator(settings.estimator).default_policy) {
          return std::nullopt;
        }
        return std::string(policy(settings.policy.kind).id);
      },
      .add =
          [](CLI::App& command, LaneSettingsOptions& options) {
            command.add_option("--policy", options.policy,
                               fmt::format("How errors become sample counts: {}; the estimator's "
                                           "own if not given",
                                           any_policy()));
          }};
}

LaneWord mode_word() {
  return {.option = "--mode",
          .word = "mode",
          .value = "M",
          .readers = "it is for all",
          .given = [](const LaneSettingsOptions& options) { return !options.mode.empty(); },
          .read_by = always,
          .put = [](const LaneSettingsOptions& options,
                    LaneSettings& settings) { settings.mode = find_sample_mode(options.mode).key; },
          .read =
              [](const std::string& value, LaneSettingsOptions& options) {
                options.mode = find_sample_mode(value).id;
                return std::string();
              },
          .said_of = [](const LaneSettings& settings) -> std::optional<std::string> {
            if (settings.mode == LaneSettings().mode) {
              return std::nullopt;
            }
            return std::string(sample_mode(settings.mode).id);
          },
          .add =
              [](CLI::App& command, LaneSettingsOptions& options) {
                command.add_option("--mode", options.mode,
                                   "reuse, the default: the samples that decide are the picture, "
                                   "which is biased; unbiased: those of a pilot run decide");
              }};
}

LaneWord max_spp_word() {
  return {.option = "--max-spp",
          .word = "max-spp",
          .value = "N",
          .readers = "it is for all",
          .given = [](const LaneSettingsOptions& options) { return options.max_spp.has_value(); },
          .read_by = always,
          .put = [](const LaneSettingsOptions& options,
                    LaneSettings& settings) { settings.max_spp = *options.max_spp; },
          .read =
              [](const std::string& value, LaneSettingsOptions& options) {
                options.max_spp = number_in(value, max_spp_range);
                return options.max_spp ? "" : out_of_range(value, max_spp_range);
              },
          .said_of = [](const LaneSettings& settings) -> std::optional<std::string> {
            if (settings.max_spp == LaneSettings().max_spp) {
              return std::nullopt;
            }
            return fmt::format("{}", settings.max_spp);
          },
          .add =
              [](CLI::App& command, LaneSettingsOptions& options) {
                add_number(
                    command, "--max-spp", options.max_spp, max_spp_range,
                    fmt::format("No pixel gets more samples than this; {} if not given, or as "
                                "many as --spp or --passes may take beyond that",
                                LaneSettings().max_spp));
              }};
}

// Each kind of parameter as text, as a value in messages, and as an option.

template <class Number>
std::string read_parameter(const Number& parameter, const std::string& text, Policy& to) {
  using Value = std::decay_t<decltype(parameter.low)>;
  Value& value = to.*parameter.member;
  const NumberRange<Value> range{parameter.low, parameter.high};
  const std::optional<Value> number = number_in(text, range);
  value = number.value_or(value);
  return number ? "" : out_of_range(text, range);
}

std::string read_parameter(const FlagParameter& parameter, const std::string&, Policy& to) {
  to.*parameter.member = true;
  return "";
}

const char* value_of(const CountParameter&) {
  return "N";
}

const char* value_of(const RealParameter&) {
  return "X";
}

const char* value_of(const FlagParameter&) {
  return "";
}

template <class Number>
void add_parameter(CLI::App& command, const Number& parameter, const std::string& option,
                   const std::string& help, std::function<void(Policy)> give) {
  using Value = std::decay_t<decltype(parameter.low)>;
  add_number_words<Value>(command, option, {parameter.low, parameter.high}, help,
                          [parameter, give](const std::vector<Value>& values) {
                            Policy given;
                            given.*parameter.member = values.front();
                            give(given);
                          });
}

void add_parameter(CLI::App& command, const FlagParameter& parameter, const std::string& option,
                   const std::string& help, std::function<void(Policy)> give) {
  command.add_flag_callback(
      option,
      [parameter, give] {
        Policy given;
        given.*parameter.member = true;
        give(given);
      },
      help);
}

std::string option_of(const PolicyParameter& row) {
  std::string option = fmt::format("--{}", row.id);
  std::ranges::replace(option, '_', '-');
  return option;
}

std::string readers_of(const PolicyParameter& row) {
  const std::string ids = policies_reading(row.key);
  const bool several = ids.find(',') != std::string::npos;
  return fmt::format("it is for the {} {}", several ? "policies" : "policy", ids);
}

/// A row that lives as long as the program.
LaneWord parameter_word(const PolicyParameter& row) {
  const auto visit_value = [&row](const auto& visitor) { return std::visit(visitor, row.value); };
  return {
      .option = option_of(row),
      .word = std::string(row.word),
      .value = visit_value([](const auto& parameter) { return value_of(parameter); }),
      .readers = readers_of(row),
      .given =
          [&row](const LaneSettingsOptions& options) { return options.given.contains(row.key); },
      .read_by = [&row](const LaneSettings& settings) { return reads(settings, row.key); },
      .put =
          [&row](const LaneSettingsOptions& options, LaneSettings& settings) {
            copy_parameter(row, options.parameters, settings.policy);
          },
      .read =
          [&row, visit_value](const std::string& text, LaneSettingsOptions& options) {
            options.given.insert(row.key);
            return visit_value([&](const auto& parameter) {
              return read_parameter(parameter, text, options.parameters);
            });
          },
      // 0 leaves it to the policy where that is the default.
      .said_of =
          [visit_value](const LaneSettings& settings) {
            return visit_value([&](const auto& parameter) -> std::optional<std::string> {
              const auto value = settings.policy.*parameter.member;
              const bool usual = value == Policy().*parameter.member;
              return usual && value == decltype(value)() ? std::nullopt
                                                         : std::optional(fmt::format("{}", value));
            });
          },
      .add =
          [&row, visit_value](CLI::App& command, LaneSettingsOptions& options) {
            const auto give = [&row, &options](const Policy& given) {
              options.given.insert(row.key);
              copy_parameter(row, given, options.parameters);
            };
            const std::string help = fmt::format("{}: {}", policies_reading(row.key), row.help);
            visit_value([&](const auto& parameter) {
              add_parameter(command, parameter, option_of(row), help, give);
            });
          }};
}

std::vector<LaneWord> all_words() {
  std::vector<LaneWord> words{policy_word(), mode_word()};
  for (const PolicyParameter& row : policy_parameters()) {
    words.push_back(parameter_word(row));
  }
  words.push_back(max_spp_word());
  return words;
}

/// "kl runs under vote", "uniform estimates no error".
std::string runs_text(const LaneSettings& settings) {
  const Estimator& row = estimator(settings.estimator);
  return row.channels == 0
             ? fmt::format("{} estimates no error", row.id)
             : fmt::format("{} runs under {}", row.id, policy(settings.policy.kind).id);
}

/// What each lane runs under, those of equal lanes once.
std::string all_runs_text(std::span<const ChosenLane> lanes) {
  std::vector<std::string> texts;
  for (const ChosenLane& lane : lanes) {
    add_once(texts, runs_text(lane.settings));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

void check_word(const LaneWord& row, const LaneSettingsOptions& options,
                std::span<const ChosenLane> lanes) {
  for (const ChosenLane& lane : lanes) {
    if (row.given(lane.own) && !row.read_by(lane.settings)) {
      throw UsageError(fmt::format("--lane: {} has no effect: {}, and {}", row.word, row.readers,
                                   runs_text(lane.settings)));
    }
  }
  const auto reads = [&](const ChosenLane& lane) { return row.read_by(lane.settings); };
  const auto reads_option = [&](const ChosenLane& lane) {
    return reads(lane) && !row.given(lane.own);
  };
  if (row.given(options) && std::ranges::none_of(lanes, reads_option)) {
    throw UsageError(
        fmt::format("{} has no effect: {}", row.option,
                    std::ranges::any_of(lanes, reads)
                        ? fmt::format("every --lane that reads it has its own {}", row.word)
                        : fmt::format("{}, and {}", row.readers, all_runs_text(lanes))));
  }
}

/// The most samples that the pixels of a lane can have in the mean, those of a pilot included.
double most_mean_spp(const LaneSettings& settings) {
  return double(settings.max_spp) * (settings.mode == SampleMode::unbiased ? 2.0 : 1.0);
}

void check_agreement(std::span<const LaneSettings> lane_settings, const StopConditions& stop) {
  for (const LaneSettings& settings : lane_settings) {
    if (reads(settings, PolicyParameterId::first) && settings.policy.first > settings.max_spp) {
      throw UsageError(fmt::format("--first-samples {}: more than --max-spp {} lets a pixel have",
                                   settings.policy.first, settings.max_spp));
    }
  }
  const auto least = std::ranges::max_element(lane_settings, {}, most_mean_spp);
  if (stop.spp && least != lane_settings.end() && *stop.spp > most_mean_spp(*least)) {
    throw UsageError(
        fmt::format("--spp {:g}: never reached, as --max-spp {} lets a pixel have no "
                    "more than {:g}",
                    *stop.spp, least->max_spp, most_mean_spp(*least)));
  }
}

}  // namespace

std::span<const LaneWord> lane_words() {
  static const std::vector<LaneWord> words = all_words();
  return words;
}

void add_lane_settings_options(CLI::App& command, LaneSettingsOptions& options) {
  for (const LaneWord& row : lane_words()) {
    row.add(command, options);
  }
}

LaneSettings settings_of(const LaneSettingsOptions& options, EstimatorId estimator,
                         const LaneSettingsOptions& own) {
  LaneSettings settings = default_settings(estimator);
  for (const LaneWord& row : lane_words()) {
    const LaneSettingsOptions& from = row.given(own) ? own : options;
    if (row.given(from) && row.read_by(settings)) {
      row.put(from, settings);
    }
  }
  return settings;
}

std::vector<LaneSettings> checked_settings(const LaneSettingsOptions& options,
                                           std::span<const ChosenLane> lanes,
                                           const StopConditions& stop) {
  for (const LaneWord& row : lane_words()) {
    check_word(row, options, lanes);
  }
  const std::uint32_t usual = LaneSettings().max_spp;
  const bool more = stop.spp.value_or(0.0) > usual || stop.passes.value_or(0) > usual;
  std::vector<LaneSettings> lane_settings;
  for (const ChosenLane& lane : lanes) {
    lane_settings.push_back(lane.settings);
    if (more && !options.max_spp && !lane.own.max_spp) {
      lane_settings.back().max_spp = most_spp;
    }
  }
  check_agreement(lane_settings, stop);
  return lane_settings;
}

}  // namespace quartet
