#include "renderer/study/stability/stability_summary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

namespace quartet {
namespace {

/// Trials of one kind in one case, by seed.
using Trials = std::map<std::uint64_t, const Trial*>;

Trials select(const CaseResult& result, EstimatorId estimator, Tuning tuning, SampleMode mode,
              Variation variation) {
  Trials trials;
  for (const Trial& trial : result.trials) {
    if (trial.settings.estimator == estimator && trial.tuning == tuning &&
        trial.settings.mode == mode && trial.variation == variation) {
      trials[trial.seed] = &trial;
    }
  }
  return trials;
}

std::vector<double> values_of(const Trials& trials, double Outcome::*value) {
  std::vector<double> values;
  for (const auto& [seed, trial] : trials) {
    values.push_back(trial->outcome.*value);
  }
  return values;
}

/// Standard deviation in relation to the mean.
double spread_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return mean > 0.0 ? std::sqrt(squares / double(values.size() - 1)) / mean : 0.0;
}

/// What the others are compared with.
Trials uniform_trials(const CaseResult& result, Variation variation) {
  return select(result, EstimatorId::uniform, Tuning::budget, SampleMode::reuse, variation);
}

/// Where the truth is known exactly the energy is compared with it; else with that of uniform
/// sampling with the same seeds, which is unbiased, shares samples and so much of the noise, and,
/// unlike a rendered truth, has a noise that is seen in the spread over seeds.
BiasTest bias_of(const CaseResult& result, const Trials& trials, double Outcome::*energy,
                 double p) {
  std::vector<double> off = values_of(trials, energy);
  if (result.truth.spp > 0) {
    const std::vector<double> uniform = values_of(uniform_trials(result, Variation::none), energy);
    assert(uniform.size() == off.size());
    for (std::size_t i = 0; i < off.size(); ++i) {
      off[i] -= uniform[i];
    }
  }
  return {mean_interval(off, p), mean_p(off, 0.0)};
}

/// Ratio of error × time, which does not depend on how long either ran as long as errors fall as
/// 1/samples: the geometric mean over seeds.
Interval equal_time_of(const CaseResult& result, const Trials& trials, double p) {
  const Trials uniform = uniform_trials(result, Variation::none);
  std::vector<double> logs;
  for (const auto& [seed, trial] : trials) {
    const Outcome& ours = trial->outcome;
    const Outcome& theirs = uniform.at(seed)->outcome;
    const double ratio = ours.relmse * ours.seconds / (theirs.relmse * theirs.seconds);
    if (!(ratio > 0.0 && std::isfinite(ratio))) {
      return {1.0, 0.0, std::numeric_limits<double>::infinity()};  // nothing to compare
    }
    logs.push_back(std::log(ratio));
  }
  const Interval interval = mean_interval(logs, p);
  return {std::exp(interval.mean), std::exp(interval.low), std::exp(interval.high)};
}

/// In relation to the plain experiment with the same seeds.
std::optional<Change> change_of(const Trials& plain, const Trials& varied) {
  if (varied.empty()) {
    return std::nullopt;
  }
  double cost = 0.0;
  double plain_cost = 0.0;
  double error = 0.0;
  double plain_error = 0.0;
  for (const auto& [seed, trial] : varied) {
    const Outcome& before = plain.at(seed)->outcome;
    cost += trial->outcome.mean_spp;
    plain_cost += before.mean_spp;
    error += trial->outcome.relmse;
    plain_error += before.relmse;
  }
  return Change{cost / plain_cost, plain_error > 0.0 ? error / plain_error : 1.0};
}

Interval audit_of(const Trials& trials, double p, double& audited) {
  double wrong = 0.0;
  audited = 0.0;
  for (const auto& [seed, trial] : trials) {
    wrong += trial->outcome.audit.wrong;
    audited += trial->outcome.audit.done;
  }
  return share_interval(wrong, audited, p);
}

Cell cell_of(const CaseResult& result, EstimatorId estimator, Tuning tuning, double p) {
  const auto of = [&](SampleMode mode, Variation variation) {
    return select(result, estimator, tuning, mode, variation);
  };
  const Trials reuse = of(SampleMode::reuse, Variation::none);
  const Trials unbiased = of(SampleMode::unbiased, Variation::none);
  Cell cell;
  cell.failure = result.failure;
  cell.tuning = tuning;
  cell.settings = reuse.begin()->second->settings;
  for (const OutcomeColumn& column : outcome_columns()) {
    cell.values.push_back(mean_interval(values_of(reuse, column.value), p));
  }
  cell.picture = bias_of(result, reuse, &Outcome::energy, p);
  cell.region = bias_of(result, reuse, &Outcome::region_energy, p);
  cell.unbiased_picture = bias_of(result, unbiased, &Outcome::energy, p);
  cell.unbiased_region = bias_of(result, unbiased, &Outcome::region_energy, p);
  cell.audit = audit_of(reuse, p, cell.audited);
  cell.equal_time = equal_time_of(result, reuse, p);
  cell.price = mean_of(values_of(unbiased, &Outcome::seconds)) /
               mean_of(values_of(reuse, &Outcome::seconds));
  cell.cost_spread = spread_of(values_of(reuse, &Outcome::mean_spp));
  cell.error_spread = spread_of(values_of(reuse, &Outcome::relmse));
  for (const VariationRow& row : variations()) {
    if (row.key != Variation::none) {
      cell.changes[std::size_t(row.key)] = change_of(reuse, of(SampleMode::reuse, row.key));
    }
  }
  if (std::optional<Change>& enlarged = cell.changes[std::size_t(Variation::resolution)]) {
    const std::optional<Change> uniform = change_of(uniform_trials(result, Variation::none),
                                                    uniform_trials(result, Variation::resolution));
    enlarged->error /= uniform->error > 0.0 ? uniform->error : 1.0;
  }
  return cell;
}

}  // namespace

double Confidence::each() const {
  return sidak(family, tests);
}

const Interval& Cell::value(std::string_view column) const {
  const auto columns = outcome_columns();
  const auto place = std::ranges::find(columns, column, &OutcomeColumn::id);
  assert(place != columns.end());
  return values[std::size_t(place - columns.begin())];
}

StabilitySummary summarize(std::span<const CaseResult> results, double family) {
  StabilitySummary summary;
  if (results.empty()) {
    return summary;
  }
  std::vector<EstimatorId> ids;
  for (const Trial& trial : results.front().trials) {
    const EstimatorId id = trial.settings.estimator;
    if (id != EstimatorId::uniform && id != EstimatorId::oracle &&
        std::ranges::find(ids, id) == ids.end()) {
      ids.push_back(id);
    }
  }
  constexpr std::array tunings{Tuning::usual, Tuning::budget};
  // Picture and region of every cell.
  summary.confidence = {family, double(2 * results.size() * ids.size() * tunings.size())};
  for (const CaseResult& result : results) {
    for (const EstimatorId id : ids) {
      for (const Tuning tuning : tunings) {
        summary.cells.push_back(cell_of(result, id, tuning, summary.confidence.each()));
      }
    }
  }
  return summary;
}

}  // namespace quartet
