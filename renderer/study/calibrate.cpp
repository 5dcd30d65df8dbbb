#include "renderer/study/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/base/number_text.h"

namespace quartet {
namespace {

constexpr double close_enough = 0.01;  // of the budget: met
// Nearer than this the search ends; measured seconds vary more than a hundredth of a percent.
constexpr double spot_on = 0.001;
constexpr double spot_on_seconds = 0.004;
// Thresholds so high that everything is done, so low that nothing is; products with any sensible
// default are still ordinary floats.
constexpr double extreme = 0x1p50;
constexpr int most_runs = 80;
/// Rounds after which a uniform run that does not reach an error is given up.
constexpr std::uint32_t most_uniform_passes = 1u << 14;

void check(const CommonBudget& budget, const Experiment& experiment) {
  const int given =
      int(budget.spp.has_value()) + int(budget.seconds.has_value()) + int(budget.error.has_value());
  if (given != 1 || budget.passes == 0) {
    throw std::invalid_argument(
        "a budget is one of samples, seconds and error, within at least one pass");
  }
  if (budget.error && experiment.reference() == nullptr) {
    throw std::invalid_argument("an error can only be a budget where there is a reference");
  }
}

/// How many times the budget a run took; for an error, how many times better than the target it
/// is. Above 1: the thresholds are too low.
double spending(const CommonBudget& budget, const Measurement& run) {
  if (!budget.error) {
    return budget.of(run) / (budget.spp ? *budget.spp : *budget.seconds);
  }
  return times_better(metric(budget.error->metric), run.values.front(), budget.error->value);
}

/// One search; keeps the nearest run that was seen.
class Search {
 public:
  Search(Experiment& experiment, const LaneSettings& settings, const CommonBudget& budget,
         std::stop_token stop)
      : experiment_(experiment), settings_(settings), budget_(budget), stop_(std::move(stop)) {}

  /// Whether it was not stopped.
  bool run() {
    return estimator(settings_.estimator).channels == 0 ? run_uniform() : bracket() && bisect();
  }

  Calibration take() {
    const double off = std::abs(std::log(best_spending_));
    best_.met = off <= std::log1p(close_enough);
    if (!best_.met) {
      best_.reason = reason();
    }
    return std::move(best_);
  }

 private:
  RunPlan plan(double factor) const {
    RunPlan plan{.settings = scaled_thresholds(settings_, factor), .stop = {}};
    plan.stop.passes = budget_.passes;
    if (budget_.error) {
      plan.metrics = {budget_.error->metric};
    } else if (factor < extreme) {
      // A run that has spent more after fewer passes need not go on, unless none would spend less.
      constexpr double too_much = 1.02;
      plan.stop.spp = budget_.spp ? std::optional(too_much * *budget_.spp) : std::nullopt;
      plan.stop.seconds =
          budget_.seconds ? std::optional(too_much * *budget_.seconds) : std::nullopt;
    }
    return plan;
  }

  bool nearer(double spent) const {
    return std::abs(std::log(spent)) < std::abs(std::log(best_spending_));
  }

  void consider(const LaneSettings& settings, double factor, const Measurement& result,
                double spent) {
    if (nearer(spent)) {
      best_spending_ = spent;
      best_.settings = settings;
      best_.factor = factor;
      best_.result = result;
      best_.capped = capped_pixels(experiment_.lane());
    }
  }

  /// Runs with a factor and says how many times the budget it takes; nothing if stopped.
  std::optional<double> spending_at(double factor) {
    const RunPlan planned = plan(factor);
    const auto measured = experiment_.run(planned, stop_);
    if (!measured) {
      return std::nullopt;
    }
    ++best_.runs;
    const Measurement& result = measured->back();
    const double spent = spending(budget_, result);
    // One that was cut short is on the far side, and no answer.
    if (result.record.pass == budget_.passes || experiment_.lane().plan().total == 0) {
      consider(planned.settings, factor, result, spent);
    }
    return spent;
  }

  /// Finds factors on both sides of the budget, or ends at the side where there is none.
  bool bracket() {
    constexpr double step = 4.0;
    const std::optional<double> start = spending_at(1.0);
    if (!start) {
      return false;
    }
    low_ = high_ = 1.0;
    const bool up = *start > 1.0;
    for (double factor = 1.0; !bracketed_;) {
      if (factor >= extreme || factor <= 1.0 / extreme) {
        return true;  // the end, and still on the same side
      }
      // A few steps, and then all the way: far out nothing but the end is new.
      factor *= up ? step : 1.0 / step;
      factor = factor > 0x1p12 ? extreme : factor < 0x1p-12 ? 1.0 / extreme : factor;
      const std::optional<double> spent = spending_at(factor);
      if (!spent) {
        return false;
      }
      bracketed_ = (*spent > 1.0) != up;
      (up == bracketed_ ? high_ : low_) = factor;
    }
    return true;
  }

  bool bisect() {
    const double enough = budget_.seconds ? spot_on_seconds : spot_on;
    while (bracketed_ && best_.runs < most_runs && high_ > low_ * (1.0 + 1e-6) &&
           std::abs(std::log(best_spending_)) > enough) {
      const double middle = std::sqrt(low_ * high_);
      const std::optional<double> spent = spending_at(middle);
      if (!spent) {
        return false;
      }
      (*spent > 1.0 ? low_ : high_) = middle;
    }
    return true;
  }

  bool run_uniform() {
    RunPlan planned{.settings = settings_, .stop = {}};
    planned.stop = {.passes = most_uniform_passes,
                    .spp = budget_.spp,
                    .seconds = budget_.seconds,
                    .error = budget_.error};
    if (budget_.error) {
      planned.metrics = {budget_.error->metric};
    }
    planned.measure_at = MeasureAt::every_pass;
    const auto measured = experiment_.run(planned, stop_);
    if (!measured) {
      return false;
    }
    best_.runs = 1;
    for (const Measurement& each : *measured) {
      consider(settings_, 1.0, each, spending(budget_, each));
    }
    return true;
  }

  /// In one line, why the best is not good enough.
  std::string reason() const {
    const std::string nearest = nearest_text();
    if (estimator(settings_.estimator).channels == 0) {
      return fmt::format("whole passes come no nearer than {}", nearest);
    }
    if (bracketed_) {
      return fmt::format("no threshold comes nearer than {}", nearest);
    }
    const bool too_much = best_spending_ > 1.0;
    const std::string_view id = policy(settings_.policy.kind).id;
    return budget_.error ? fmt::format("{} passes of {} with {} threshold give {}", budget_.passes,
                                       id, too_much ? "the highest" : "the lowest", nearest)
                         : fmt::format("{} passes of {} take at {} {}", budget_.passes, id,
                                       too_much ? "least" : "most", nearest);
  }

  std::string nearest_text() const {
    CommonBudget nearest = budget_;
    const double value = budget_.of(best_.result);
    if (budget_.spp) {
      nearest.spp = value;
    } else if (budget_.seconds) {
      nearest.seconds = value;
    } else {
      nearest.error->value = value;
    }
    return nearest.text();
  }

  Experiment& experiment_;
  const LaneSettings settings_;
  const CommonBudget budget_;
  const std::stop_token stop_;
  Calibration best_;
  double best_spending_ = 0.0;  // of none yet
  double low_ = 1.0;            // spends too much
  double high_ = 1.0;           // spends too little
  bool bracketed_ = false;
};

}  // namespace

std::string CommonBudget::text() const {
  if (spp) {
    return format_number(*spp) + " spp";
  }
  if (seconds) {
    return format_number(*seconds) + " s";
  }
  return error ? fmt::format("{} {}", metric(error->metric).id, format_number(error->value)) : "";
}

double CommonBudget::of(const Measurement& run) const {
  return spp ? run.mean_spp : seconds ? run.record.seconds : run.values.front();
}

LaneSettings scaled_thresholds(LaneSettings settings, double factor) {
  for (float& threshold : settings.thresholds) {
    threshold = float(double(threshold) * factor);
  }
  return settings;
}

std::optional<Calibration> calibrate(Experiment& experiment, const LaneSettings& settings,
                                     const CommonBudget& budget, std::stop_token stop) {
  check(budget, experiment);
  Search search(experiment, settings, budget, std::move(stop));
  if (!search.run()) {
    return std::nullopt;
  }
  return search.take();
}

}  // namespace quartet
