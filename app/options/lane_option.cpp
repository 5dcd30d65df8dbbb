#include "app/options/lane_option.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/options/usage_error.h"

namespace quartet {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& reason) {
  std::string words;
  for (const LaneWord& row : lane_words()) {
    words += fmt::format("{}{}{}{}", words.empty() ? "" : ", ", row.word,
                         row.value.empty() ? "" : "=", row.value);
  }
  throw UsageError(
      fmt::format("--lane: '{}': {}; write ESTIMATOR or ESTIMATOR:THRESHOLDS with {} "
                  "as wanted, such as contrast:0.4,0.3,0.6,multiplier=1",
                  text, reason, words));
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// Reads one word of a lane that is not a threshold; false if none of the table is called so.
bool read_word(const std::string& text, const std::string& word, LaneSettingsOptions& own) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  for (const LaneWord& row : lane_words()) {
    if (row.word != name) {
      continue;
    }
    if (row.given(own)) {
      fail(text, fmt::format("{} is there twice", name));
    }
    const bool has_value = equals != std::string::npos;
    if (has_value == row.value.empty()) {
      fail(text, fmt::format("{} {}", name, has_value ? "takes no value" : "needs a value"));
    }
    const std::string wrong = row.read(has_value ? word.substr(equals + 1) : "", own);
    if (!wrong.empty()) {
      fail(text, fmt::format("{}: {}", name, wrong));
    }
    return true;
  }
  return false;
}

ChosenLane lane_of(const std::string& text, const LaneSettingsOptions& options) {
  const std::size_t colon = text.find(':');
  const Estimator& row = find_estimator(text.substr(0, colon));
  LaneSettingsOptions own;
  std::vector<float> thresholds;
  if (colon != std::string::npos) {
    for (const std::string& word : split(text.substr(colon + 1))) {
      if (read_word(text, word, own)) {
        continue;
      }
      if (thresholds.size() == std::size_t(row.channels)) {
        fail(text, fmt::format("'{}' is one too many or unknown", word));
      }
      const std::optional<float> number = number_in(word, threshold_limits);
      if (!number) {
        fail(text, out_of_range(word, threshold_limits));
      }
      thresholds.push_back(*number);
    }
  }
  ChosenLane lane{settings_of(options, row.key, own), own};
  if (thresholds.size() == 1) {
    lane.settings.thresholds.fill(thresholds.front());
  } else if (!thresholds.empty()) {
    if (thresholds.size() != std::size_t(row.channels)) {
      fail(text, fmt::format("{} thresholds, not 1 or {}", thresholds.size(), row.channels));
    }
    std::ranges::copy(thresholds, lane.settings.thresholds.begin());
  }
  return lane;
}

}  // namespace

void add_lane_options(CLI::App& command, LaneOptions& options) {
  CLI::Option* const estimators_option =
      command.add_option("--estimators", options.estimators, "Which, separated by commas")
          ->delimiter(',')
          ->capture_default_str();
  command
      .add_option("--lane", options.lanes,
                  "A lane with its own thresholds, once for each, instead of --estimators: "
                  "kl:0.004,multiplier=1")
      ->allow_extra_args(false)
      ->excludes(estimators_option);
}

std::vector<LaneSettings> settings_of_lanes(const LaneOptions& options,
                                            const LaneSettingsOptions& all,
                                            const StopConditions& stop) {
  std::vector<ChosenLane> lanes;
  for (const std::string& text : options.lanes) {
    lanes.push_back(lane_of(text, all));
  }
  for (const std::string& id :
       options.lanes.empty() ? options.estimators : std::vector<std::string>()) {
    const EstimatorId key = find_estimator(id).key;
    for (const ChosenLane& other : lanes) {
      if (other.settings.estimator == key) {
        throw UsageError(fmt::format("--estimators: '{}' is named twice; name each once", id));
      }
    }
    lanes.push_back({settings_of(all, key), {}});
  }
  return checked_settings(all, lanes, stop);
}

std::string lane_text(const LaneSettings& settings) {
  const Estimator& row = estimator(settings.estimator);
  std::string text(row.id);
  char separator = ':';
  const auto add = [&](const std::string& word) {
    text += separator + word;
    separator = ',';
  };
  for (int c = 0; c < row.channels; ++c) {
    add(fmt::format("{}", settings.thresholds[std::size_t(c)]));
  }
  // Those without a value, which are the longest, last.
  for (const bool has_value : {true, false}) {
    for (const LaneWord& word : lane_words()) {
      if (word.value.empty() == has_value || !word.read_by(settings)) {
        continue;
      }
      if (const std::optional<std::string> value = word.said_of(settings)) {
        add(has_value ? fmt::format("{}={}", word.word, *value) : word.word);
      }
    }
  }
  return text;
}

LaneSettings parse_lane(const std::string& text, const LaneSettingsOptions& options) {
  const ChosenLane lane = lane_of(text, options);
  return checked_settings({}, std::span(&lane, 1), {}).front();
}

}  // namespace quartet
