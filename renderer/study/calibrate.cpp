#include "renderer/study/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/base/number_text.h"
#include "renderer/study/threshold_scan.h"

namespace quartet {
namespace {

constexpr double close_enough = 0.01;  // of the budget: met
// Nearer than this the search ends; measured seconds vary more than a hundredth of a percent.
constexpr double spot_on = 0.001;
constexpr double spot_on_seconds = 0.004;
constexpr int most_runs = 80;

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
/// is.
double spending(const CommonBudget& budget, const Measurement& run) {
  if (!budget.error) {
    return budget.of(run) / (budget.spp ? *budget.spp : *budget.seconds);
  }
  return times_better(metric(budget.error->metric), run.values.front(), budget.error->value);
}

/// What of two runs with the same error the better one has less of.
double cost_of(const PassRecord& record) {
  return double(record.rays > 0 ? record.rays : record.samples);
}

/// One search; keeps the nearest run that was seen.
class Search {
 public:
  Search(Experiment& experiment, const LaneSettings& settings, const CommonBudget& budget,
         std::stop_token stop)
      : experiment_(experiment), settings_(settings), budget_(budget), stop_(std::move(stop)) {}

  /// Whether it was not stopped.
  bool run() {
    if (estimator(settings_.estimator).channels == 0) {
      return run_uniform();
    }
    return budget_.error ? scan() : bracket() && bisect();
  }

  Calibration take() {
    const double off = std::log(best_spending_);
    best_.met = budget_.error ? off >= 0.0 : std::abs(off) <= std::log1p(close_enough);
    if (!best_.met) {
      best_.reason = reason();
    } else if (budget_.error && off > std::log1p(close_enough)) {
      best_.note = note();
    }
    return std::move(best_);
  }

 private:
  RunPlan plan(double factor) const {
    RunPlan plan{.settings = scaled_thresholds(settings_, factor), .stop = {}};
    plan.stop.passes = budget_.passes;
    if (budget_.error) {
      plan.metrics = {budget_.error->metric};
    } else if (factor < extreme_factor) {
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

  void keep(const LaneSettings& settings, double factor, const Measurement& result, double spent) {
    best_spending_ = spent;
    best_.settings = settings;
    best_.factor = factor;
    best_.result = result;
    best_.capped = capped_pixels(experiment_.lane());
  }

  /// The end of a run; nothing if stopped.
  std::optional<Measurement> end_of(const RunPlan& planned) {
    auto measured = experiment_.run(planned, stop_);
    if (!measured) {
      return std::nullopt;
    }
    ++best_.runs;
    return std::move(measured->back());
  }

  /// Runs with a factor and says how many times the budget it takes; nothing if stopped.
  std::optional<double> spending_at(double factor) {
    const RunPlan planned = plan(factor);
    const auto result = end_of(planned);
    if (!result) {
      return std::nullopt;
    }
    const double spent = spending(budget_, *result);
    // One that was cut short is on the far side, and no answer.
    const bool whole =
        result->record.pass == budget_.passes || experiment_.lane().plan().total == 0;
    if (whole && nearer(spent)) {
      keep(planned.settings, factor, *result, spent);
    }
    return spent;
  }

  /// For an error.
  bool scan() {
    std::optional<ScannedRun> kept;
    const auto run = [&](double factor) -> std::optional<ScannedRun> {
      const RunPlan planned = plan(factor);
      const auto result = end_of(planned);
      if (!result) {
        return std::nullopt;
      }
      const ScannedRun scanned{factor, spending(budget_, *result), cost_of(result->record)};
      if (!kept || scanned.is_better_than(*kept)) {
        kept = scanned;
        keep(planned.settings, factor, *result, scanned.quality);
      }
      return scanned;
    };
    scanned_ = scan_thresholds(run);
    return scanned_.has_value();
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
      if (factor >= extreme_factor || factor <= 1.0 / extreme_factor) {
        return true;  // the end, and still on the same side
      }
      // A few steps, and then all the way: far out nothing but the end is new.
      factor *= up ? step : 1.0 / step;
      factor = factor > 0x1p12 ? extreme_factor : factor < 0x1p-12 ? 1.0 / extreme_factor : factor;
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
    planned.stop = {.passes = budget_.uniform_passes,
                    .spp = budget_.spp,
                    .seconds = budget_.seconds,
                    .error = budget_.error};
    if (budget_.error) {
      planned.metrics = {budget_.error->metric};
    } else {
      planned.measure_at = MeasureAt::every_pass;
    }
    const auto measured = experiment_.run(planned, stop_);
    if (!measured) {
      return false;
    }
    best_.runs = 1;
    for (const Measurement& each : *measured) {
      const double spent = spending(budget_, each);
      // Of an error there is one, and where it is 0 nothing is nearer than anything.
      if (budget_.error || nearer(spent)) {
        keep(settings_, 1.0, each, spent);
      }
    }
    return true;
  }

  /// In one line, why the best is not good enough.
  std::string reason() const {
    const std::string nearest = nearest_text();
    if (estimator(settings_.estimator).channels == 0) {
      return budget_.error
                 ? fmt::format("{} whole passes give {}", best_.result.record.pass, nearest)
                 : fmt::format("whole passes come no nearer than {}", nearest);
    }
    const std::string_view id = policy(settings_.policy.kind).id;
    if (budget_.error) {
      return fmt::format("{} passes of {} come no nearer than {}, the best of {} thresholds tried",
                         budget_.passes, id, nearest, scanned_->runs.size());
    }
    if (bracketed_) {
      return fmt::format("no threshold comes nearer than {}", nearest);
    }
    return fmt::format("{} passes of {} take at {} {}", budget_.passes, id,
                       best_spending_ > 1.0 ? "least" : "most", nearest);
  }

  /// In one line, why the best is better than it need be; empty where whole passes explain it.
  std::string note() const {
    const std::string nearest = nearest_text();
    if (!scanned_) {
      return best_.result.record.pass > 1
                 ? ""
                 : fmt::format("already better than asked: one pass gives {}", nearest);
    }
    return scanned_->always
               ? fmt::format("already better than asked at every threshold; the cheapest gives {}",
                             nearest)
               : fmt::format("better than asked: the cheapest threshold that meets it gives {}",
                             nearest);
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
  std::optional<ThresholdScan> scanned_;  // for an error
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
