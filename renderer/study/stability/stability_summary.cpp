#include "renderer/study/stability/stability_summary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace quartet {
namespace {

/// Trials of one kind in one case, by seed.
using Trials = std::map<std::uint64_t, const Trial*>;

/// What a group of trials has in common.
struct Kind {
  std::string_view subject;
  Terms terms = Terms::budget;
  SampleMode mode = SampleMode::reuse;
  Variation variation = Variation::none;
};

Trials select(const CaseResult& result, const Kind& kind) {
  Trials trials;
  for (const Trial& trial : result.trials) {
    if (trial.subject == kind.subject && trial.terms == kind.terms &&
        trial.settings.mode == kind.mode && trial.variation == kind.variation) {
      trials[trial.seed] = &trial;
    }
  }
  return trials;
}

/// What a member or a function says of each outcome.
template <class Value>
std::vector<double> values_of(const Trials& trials, const Value& value) {
  std::vector<double> values;
  values.reserve(trials.size());
  for (const auto& [seed, trial] : trials) {
    values.push_back(std::invoke(value, trial->outcome));
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

std::vector<Audit::Look> looks_of(const Trials& trials) {
  std::vector<Audit::Look> looks;
  for (const auto& [seed, trial] : trials) {
    looks.insert(looks.end(), trial->outcome.audit.begin(), trial->outcome.audit.end());
  }
  return looks;
}

/// What cost and error become with each variation.
void set_changes(Cell& cell, const CaseResult& result, const Trials& plain) {
  const auto of = [&](std::string_view subject, Variation variation) {
    return select(result, {.subject = subject, .variation = variation});
  };
  for (const VariationRow& row : variations()) {
    if (row.key != Variation::none) {
      cell.changes[std::size_t(row.key)] = change_of(plain, of(cell.subject.id, row.key));
    }
  }
  if (std::optional<Change>& enlarged = cell.changes[std::size_t(Variation::resolution)]) {
    const std::string_view uniform = estimator(EstimatorId::uniform).id;
    const std::optional<Change> alike =
        change_of(of(uniform, Variation::none), of(uniform, Variation::resolution));
    enlarged->error /= alike->error > 0.0 ? alike->error : 1.0;
  }
}

Cell cell_of(const CaseResult& result, const Subject& subject, Terms terms, const Trials& trials,
             double p) {
  Cell cell;
  cell.failure = result.failure;
  cell.subject = subject;
  cell.subject.settings = trials.begin()->second->settings;
  cell.terms = terms;
  for (const Rule& rule : rules()) {
    if (rule.applies(subject, terms)) {
      cell.findings.push_back(judge(rule, values_of(trials, rule.effect), p));
    }
  }
  for (const OutcomeColumn& column : outcome_columns()) {
    cell.values.push_back(mean_interval(values_of(trials, column.value), p));
  }
  const std::vector<Audit::Look> looks = looks_of(trials);
  cell.audit = wrong_share_interval(looks, p);
  cell.audited = double(looks.size());
  cell.cost_spread = spread_of(values_of(trials, &Outcome::mean_spp));
  cell.error_spread = spread_of(values_of(trials, &Outcome::relmse));
  const Trials twins =
      select(result, {.subject = subject.id, .terms = terms, .mode = SampleMode::unbiased});
  if (!twins.empty()) {
    const Rule& bias = rules().front();
    cell.twin = judge(bias, values_of(twins, bias.effect), p);
    cell.price = mean_of(values_of(twins, &Outcome::mean_spp)) /
                 mean_of(values_of(trials, &Outcome::mean_spp));
  }
  if (terms == Terms::budget) {
    set_changes(cell, result, trials);
  }
  return cell;
}

/// Calls visit(result, subject, terms, its plain trials) for each cell that there is.
template <class Visit>
void for_each_cell(std::span<const CaseResult> results, const Visit& visit) {
  for (const CaseResult& result : results) {
    for (const TermsRow& terms : terms_table()) {
      for (const Subject& subject : result.subjects) {
        const Trials trials = select(result, {.subject = subject.id, .terms = terms.key});
        if (!trials.empty()) {
          visit(result, subject, terms.key, trials);
        }
      }
    }
  }
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

const Finding& Cell::deciding() const {
  for (const Verdict verdict : {Verdict::fails, Verdict::open}) {
    const auto found = std::ranges::find(findings, verdict, &Finding::verdict);
    if (found != findings.end()) {
      return *found;
    }
  }
  return findings.back();
}

StabilitySummary summarize(std::span<const CaseResult> results, double family) {
  StabilitySummary summary;
  std::size_t tests = 0;
  for_each_cell(results,
                [&](const CaseResult&, const Subject& subject, Terms terms, const Trials&) {
                  tests += std::size_t(std::ranges::count_if(
                      rules(), [&](const Rule& rule) { return rule.applies(subject, terms); }));
                  tests += subject.role == Role::studied && terms == Terms::budget ? 1 : 0;
                });
  summary.confidence = {family, std::max(double(tests), 1.0)};
  for_each_cell(results, [&](const CaseResult& result, const Subject& subject, Terms terms,
                             const Trials& trials) {
    summary.cells.push_back(cell_of(result, subject, terms, trials, summary.confidence.each()));
  });
  return summary;
}

}  // namespace quartet
