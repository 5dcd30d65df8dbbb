#include "app/options/policy_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "app/options/usage_error.h"
#include "renderer/adaptive/estimators/estimator.h"

namespace quartet {
namespace {

constexpr NumberRange<std::uint16_t> batch_range{0, 65535};
constexpr NumberRange<float> multiplier_range{0.0f, 1000.0f};
constexpr NumberRange<std::uint32_t> max_spp_range{1, most_spp};

/// "two-level, batch, converge": those that read a field.
std::string policies_reading(bool AllocationFields::*field) {
  std::string ids;
  for (const AllocationRow& row : allocations()) {
    if (row.reads.*field) {
      ids += fmt::format("{}{}", ids.empty() ? "" : ", ", row.id);
    }
  }
  return ids;
}

template <bool AllocationFields::*field>
std::string readers_of() {
  const std::string ids = policies_reading(field);
  const bool several = ids.find(',') != std::string::npos;
  return fmt::format("it is for the {} {}", several ? "policies" : "policy", ids);
}

template <bool AllocationFields::*field>
bool is_read(const SamplingPolicy& policy) {
  return fields_read(policy).*field;
}

bool has_policy(const SamplingPolicy& policy) {
  return estimator(policy.estimator).channels > 0;
}

bool always(const SamplingPolicy&) {
  return true;
}

template <auto member>
bool is_given(const PolicyOptions& options) {
  return bool(options.*member);
}

template <auto member>
bool is_named(const PolicyOptions& options) {
  return !(options.*member).empty();
}

template <auto member, const auto& range>
std::string read_number(const std::string& value, PolicyOptions& options) {
  options.*member = number_in(value, range);
  return options.*member ? "" : out_of_range(value, range);
}

constexpr std::array policy_table{
    PolicyParameter{"--policy", "policy", true,
                    [] { return std::string("it is for estimators of errors"); },
                    is_named<&PolicyOptions::policy>, has_policy,
                    [](const PolicyOptions& options, SamplingPolicy& policy) {
                      policy.allocation.kind = find_allocation(options.policy).key;
                    },
                    [](const std::string& value, PolicyOptions& options) {
                      options.policy = find_allocation(value).id;
                      return std::string();
                    }},
    PolicyParameter{"--mode", "mode", true, [] { return std::string("it is for all"); },
                    is_named<&PolicyOptions::mode>, always,
                    [](const PolicyOptions& options, SamplingPolicy& policy) {
                      policy.use = find_sample_use(options.mode).key;
                    },
                    [](const std::string& value, PolicyOptions& options) {
                      options.mode = find_sample_use(value).id;
                      return std::string();
                    }},
    PolicyParameter{"--first-samples", "first", true, readers_of<&AllocationFields::first>,
                    is_given<&PolicyOptions::first_samples>, is_read<&AllocationFields::first>,
                    [](const PolicyOptions& options, SamplingPolicy& policy) {
                      policy.allocation.first = *options.first_samples;
                    },
                    read_number<&PolicyOptions::first_samples, batch_range>},
    PolicyParameter{"--batch-samples", "batch", true, readers_of<&AllocationFields::batch>,
                    is_given<&PolicyOptions::batch_samples>, is_read<&AllocationFields::batch>,
                    [](const PolicyOptions& options, SamplingPolicy& policy) {
                      policy.allocation.batch = *options.batch_samples;
                    },
                    read_number<&PolicyOptions::batch_samples, batch_range>},
    PolicyParameter{"--multiplier", "multiplier", true, readers_of<&AllocationFields::multiplier>,
                    is_given<&PolicyOptions::multiplier>, is_read<&AllocationFields::multiplier>,
                    [](const PolicyOptions& options, SamplingPolicy& policy) {
                      policy.allocation.multiplier = *options.multiplier;
                    },
                    read_number<&PolicyOptions::multiplier, multiplier_range>},
    PolicyParameter{"--stochastic-rounding", "stochastic-rounding", false,
                    readers_of<&AllocationFields::multiplier>,
                    is_given<&PolicyOptions::stochastic_rounding>,
                    is_read<&AllocationFields::multiplier>,
                    [](const PolicyOptions&, SamplingPolicy& policy) {
                      policy.allocation.stochastic_rounding = true;
                    },
                    [](const std::string&, PolicyOptions& options) {
                      options.stochastic_rounding = true;
                      return std::string();
                    }},
    PolicyParameter{"--max-spp", "max-spp", true, [] { return std::string("it is for all"); },
                    is_given<&PolicyOptions::max_spp>, always,
                    [](const PolicyOptions& options, SamplingPolicy& policy) {
                      policy.max_spp = *options.max_spp;
                    },
                    read_number<&PolicyOptions::max_spp, max_spp_range>},
};

/// "kl runs under vote", "uniform estimates no error".
std::string runs_text(const SamplingPolicy& policy) {
  const Estimator& row = estimator(policy.estimator);
  return row.channels == 0
             ? fmt::format("{} estimates no error", row.id)
             : fmt::format("{} runs under {}", row.id, allocation(policy.allocation.kind).id);
}

/// Each lane's policy, those of equal lanes once.
std::string all_runs_text(std::span<const ChosenLane> lanes) {
  std::vector<std::string> texts;
  for (const ChosenLane& lane : lanes) {
    const std::string text = runs_text(lane.policy);
    if (std::ranges::find(texts, text) == texts.end()) {
      texts.push_back(text);
    }
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

void check_parameter(const PolicyParameter& row, const PolicyOptions& options,
                     std::span<const ChosenLane> lanes) {
  for (const ChosenLane& lane : lanes) {
    if (row.given(lane.own) && !row.read_by(lane.policy)) {
      throw UsageError(fmt::format("--lane: {} has no effect: {}, and {}", row.word, row.readers(),
                                   runs_text(lane.policy)));
    }
  }
  const auto reads = [&](const ChosenLane& lane) { return row.read_by(lane.policy); };
  const auto reads_option = [&](const ChosenLane& lane) {
    return reads(lane) && !row.given(lane.own);
  };
  if (row.given(options) && std::ranges::none_of(lanes, reads_option)) {
    throw UsageError(
        fmt::format("{} has no effect: {}", row.option,
                    std::ranges::any_of(lanes, reads)
                        ? fmt::format("every --lane that reads it has its own {}", row.word)
                        : fmt::format("{}, and {}", row.readers(), all_runs_text(lanes))));
  }
}

/// The most samples that the pixels of a lane can have in the mean, those of a pilot included.
double most_mean_spp(const SamplingPolicy& policy) {
  return double(policy.max_spp) * (policy.use == SampleUse::unbiased ? 2.0 : 1.0);
}

void check_agreement(std::span<const SamplingPolicy> policies, const StopConditions& stop) {
  for (const SamplingPolicy& policy : policies) {
    if (fields_read(policy).first && policy.allocation.first > policy.max_spp) {
      throw UsageError(fmt::format("--first-samples {}: more than --max-spp {} lets a pixel have",
                                   policy.allocation.first, policy.max_spp));
    }
  }
  const auto least = std::ranges::max_element(policies, {}, most_mean_spp);
  if (stop.spp && least != policies.end() && *stop.spp > most_mean_spp(*least)) {
    throw UsageError(
        fmt::format("--spp {:g}: never reached, as --max-spp {} lets a pixel have no "
                    "more than {:g}",
                    *stop.spp, least->max_spp, most_mean_spp(*least)));
  }
}

}  // namespace

std::span<const PolicyParameter> policy_parameters() {
  return policy_table;
}

void add_policy_options(CLI::App& command, PolicyOptions& options) {
  const std::string batches = policies_reading(&AllocationFields::batch);
  const std::string votes = policies_reading(&AllocationFields::multiplier);
  command.add_option("--policy", options.policy,
                     "How errors become sample counts: vote, two-level, batch or converge; the "
                     "estimator's own if not given");
  command.add_option("--mode", options.mode,
                     "reuse, the default: the samples that decide are the picture, which is "
                     "biased; unbiased: those of a pilot run decide");
  add_number(command, "--first-samples", options.first_samples, batch_range,
             fmt::format("{}: samples before the first look; 0: the policy's own",
                         policies_reading(&AllocationFields::first)));
  add_number(command, "--batch-samples", options.batch_samples, batch_range,
             fmt::format("{}: samples from one look to the next; 0: the policy's own", batches));
  add_number(command, "--multiplier", options.multiplier, multiplier_range,
             fmt::format("{}: extra samples for each vote, {} if not given; 1 is the text of the "
                         "2021 report, 0.5 its pictures",
                         votes, Allocation().multiplier));
  command.add_flag("--stochastic-rounding", options.stochastic_rounding,
                   fmt::format("{}: round multiplier x votes at random instead of down", votes));
  add_number(command, "--max-spp", options.max_spp, max_spp_range,
             fmt::format("No pixel gets more samples than this; {} if not given, or as many as "
                         "--spp or --frames may take beyond that",
                         SamplingPolicy().max_spp));
}

SamplingPolicy policy_of(const PolicyOptions& options, EstimatorId estimator,
                         const PolicyOptions& own) {
  SamplingPolicy policy = default_policy(estimator);
  // The first row is the policy itself, which decides what of the others is read.
  for (const PolicyParameter& row : policy_table) {
    const PolicyOptions& from = row.given(own) ? own : options;
    if (row.given(from) && row.read_by(policy)) {
      row.put(from, policy);
    }
  }
  return policy;
}

std::vector<SamplingPolicy> checked_policies(const PolicyOptions& options,
                                             std::span<const ChosenLane> lanes,
                                             const StopConditions& stop) {
  for (const PolicyParameter& row : policy_table) {
    check_parameter(row, options, lanes);
  }
  const std::uint32_t usual = SamplingPolicy().max_spp;
  const bool more = stop.spp.value_or(0.0) > usual || stop.frames.value_or(0) > usual;
  std::vector<SamplingPolicy> policies;
  for (const ChosenLane& lane : lanes) {
    policies.push_back(lane.policy);
    if (more && !options.max_spp && !lane.own.max_spp) {
      policies.back().max_spp = most_spp;
    }
  }
  check_agreement(policies, stop);
  return policies;
}

}  // namespace quartet
