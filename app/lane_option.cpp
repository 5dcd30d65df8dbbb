#include "app/lane_option.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "app/commands.h"
#include "app/number_check.h"

namespace quartet {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& reason) {
  throw UsageError(
      fmt::format("--lane: '{}': {}; write ESTIMATOR or ESTIMATOR:THRESHOLDS with policy=P, "
                  "mode=M, multiplier=X, max-spp=N, first=N, batch=N, "
                  "stochastic-rounding as wanted, such as contrast:0.4,0.3,0.6,multiplier=1",
                  text, reason));
}

template <class Number>
Number number_of(const std::string& text, const std::string& word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc() || stop != end) {
    fail(text, fmt::format("'{}' is not a number", word));
  }
  return number;
}

float positive_number(const std::string& text, const std::string& word, bool zero) {
  const auto number = number_of<float>(text, word);
  if (!(std::isfinite(number) && (zero ? number >= 0.0f : number > 0.0f))) {
    fail(text, fmt::format("{} is too small or no number", word));
  }
  return number;
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

std::vector<SamplingPolicy> policies_of(const LaneOptions& options, const RunOptions& run) {
  std::vector<SamplingPolicy> policies;
  for (const std::string& lane : options.lanes) {
    policies.push_back(policy_of_lane(lane, run));
  }
  if (!policies.empty()) {
    return policies;
  }
  for (const std::string& id : options.estimators) {
    const EstimatorId key = find_estimator(id).key;
    for (const SamplingPolicy& other : policies) {
      if (other.estimator == key) {
        throw UsageError(fmt::format("--estimators: '{}' is named twice; name each once", id));
      }
    }
    policies.push_back(policy_of(run, key));
  }
  return policies;
}

std::string lane_text(const SamplingPolicy& policy) {
  const Estimator& row = estimator(policy.estimator);
  std::string text(row.id);
  char separator = ':';
  const auto add = [&](const std::string& word) {
    text += separator + word;
    separator = ',';
  };
  for (int c = 0; c < row.channels; ++c) {
    add(fmt::format("{}", policy.thresholds[std::size_t(c)]));
  }
  if (policy.allocation.kind != row.default_allocation) {
    add(fmt::format("policy={}", allocation(policy.allocation.kind).id));
  }
  if (policy.use != SamplingPolicy{}.use) {
    add(fmt::format("mode={}", sample_use(policy.use).id));
  }
  add(fmt::format("multiplier={}", policy.allocation.multiplier));
  if (policy.allocation.first > 0) {
    add(fmt::format("first={}", policy.allocation.first));
  }
  if (policy.allocation.batch > 0) {
    add(fmt::format("batch={}", policy.allocation.batch));
  }
  if (policy.max_spp != SamplingPolicy{}.max_spp) {
    add(fmt::format("max-spp={}", policy.max_spp));
  }
  if (policy.allocation.stochastic_rounding) {
    add("stochastic-rounding");
  }
  return text;
}

SamplingPolicy policy_of_lane(const std::string& text, const RunOptions& run) {
  const std::size_t colon = text.find(':');
  const Estimator& row = find_estimator(text.substr(0, colon));
  SamplingPolicy policy = policy_of(run, row.key);
  if (colon == std::string::npos) {
    return policy;
  }
  int thresholds = 0;
  for (const std::string& word : split(text.substr(colon + 1))) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (name == "policy") {
      policy.allocation.kind = find_allocation(value).key;
    } else if (name == "mode") {
      policy.use = find_sample_use(value).key;
    } else if (name == "first") {
      policy.allocation.first = number_of<std::uint16_t>(text, value);
    } else if (name == "batch") {
      policy.allocation.batch = number_of<std::uint16_t>(text, value);
    } else if (name == "multiplier") {
      policy.allocation.multiplier = positive_number(text, value, true);
    } else if (name == "max-spp") {
      policy.max_spp = std::max(1u, number_of<std::uint32_t>(text, value));
    } else if (name == "stochastic-rounding") {
      policy.allocation.stochastic_rounding = true;
    } else if (thresholds < row.channels) {
      policy.thresholds[std::size_t(thresholds++)] = positive_number(text, word, false);
    } else {
      fail(text, fmt::format("'{}' is one too many or unknown", word));
    }
  }
  if (thresholds == 1) {
    policy.thresholds = {policy.thresholds[0], policy.thresholds[0], policy.thresholds[0]};
  } else if (thresholds != 0 && thresholds != row.channels) {
    fail(text, fmt::format("{} thresholds, not 1 or {}", thresholds, row.channels));
  }
  return policy;
}

void add_view_options(CLI::App& command, ViewOptions& options) {
  command
      .add_option("--heat", options.heat,
                  "Heatmap scale: linked (0 to the highest of all) or report (each its own)")
      ->capture_default_str();
  command.add_option("--tone-map", options.tone_map, "clamp, reinhard or filmic")
      ->capture_default_str();
  command.add_option("--exposure", options.exposure, "In stops")
      ->check(number_between(-100.0, 100.0))
      ->capture_default_str();
}

std::string heat_id(HeatRange range) {
  return range == HeatRange::linked ? "linked" : "report";
}

ViewSettings view_settings(const ViewOptions& options) {
  ViewSettings view;
  view.exposure = options.exposure;
  view.tone_map = find_tone_map(options.tone_map).key;
  if (options.heat != "linked" && options.heat != "report") {
    throw UsageError(
        fmt::format("--heat: unknown scale '{}'; there are: linked, report", options.heat));
  }
  view.heat = options.heat == "linked" ? HeatRange::linked : HeatRange::report;
  return view;
}

}  // namespace quartet
