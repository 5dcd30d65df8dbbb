#include "app/records/stability_files.h"

#include <fmt/format.h>

#include <cmath>

#include "app/records/run_record.h"
#include "renderer/base/version.h"
#include "ui/paper/matrix_figure.h"

namespace quartet {
namespace {

std::string trials_csv(std::span<const CaseResult> results) {
  std::string csv =
      "case,scene,sampler,subject,estimator,policy,mode,terms,variation,thresholds,seed,pass,"
      "seconds,"
      "rays,samples,mean_spp,metric,value\n";
  for (const CaseResult& result : results) {
    for (const Trial& trial : result.trials) {
      const Outcome& outcome = trial.outcome;
      const double pixels = double(result.width) * double(result.height) *
                            (trial.variation == Variation::resolution ? 4.0 : 1.0);
      const std::string row =
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{:.6f},{:.0f},{:.0f},{:.6f}",
                      result.failure->id, result.failure->scene, sampler_row(result.sampler).id,
                      trial.subject, estimator(trial.settings.estimator).id,
                      policy(trial.settings.policy.kind).id, sample_mode(trial.settings.mode).id,
                      terms_row(trial.terms).id, variations()[std::size_t(trial.variation)].id,
                      thresholds_text(trial.settings), trial.seed, trial.passes, outcome.seconds,
                      outcome.mean_rays * pixels, outcome.mean_spp * pixels, outcome.mean_spp);
      for (const OutcomeColumn& column : outcome_columns()) {
        const double value = outcome.*column.value;
        if (column.id != "seconds" && column.id != "mean_rays" && column.id != "mean_spp" &&
            !std::isnan(value)) {
          csv += fmt::format("{},{},{:.9g}\n", row, column.id, value);
        }
      }
    }
  }
  return csv;
}

/// Rows "…,metric,value,low,high,visible,verdict" of one cell.
void add_cell(std::string& csv, const CaseResult& result, const Cell& cell) {
  const LaneSettings& settings = cell.subject.settings;
  const std::string row = fmt::format(
      "{},{},{},{},{},{},{},{},{},{:g},{},{:g}", cell.failure->id, cell.failure->scene,
      sampler_row(result.sampler).id, cell.subject.id, role_id(cell.subject.role),
      estimator(settings.estimator).id, policy(settings.policy.kind).id, terms_row(cell.terms).id,
      thresholds_text(settings), result.limit, result.truth.spp, result.truth.noise);
  const auto number = [&](std::string_view metric, double value) {
    csv += fmt::format("{},{},{:.9g},,,,\n", row, metric, value);
  };
  const auto interval = [&](std::string_view metric, const Interval& value) {
    if (std::isnan(value.mean)) {
      return;
    }
    csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},,\n", row, metric, value.mean, value.low,
                       value.high);
  };
  const auto finding = [&](std::string_view metric, const Finding& found) {
    csv +=
        fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{}\n", row, metric, found.effect.mean,
                    found.effect.low, found.effect.high, found.visible, verdict_id(found.verdict));
  };
  for (const Finding& found : cell.findings) {
    finding(fmt::format("rule_{}", found.rule->id), found);
  }
  if (cell.twin) {
    finding("rule_biased_unbiased", *cell.twin);
    number("price_of_unbiased", cell.price);
  }
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    interval(outcome_columns()[i].id, cell.values[i]);
  }
  interval("missed_by_audit", cell.audit);
  number("audited", cell.audited);
  number("cost_spread", cell.cost_spread);
  number("error_spread", cell.error_spread);
  for (const VariationRow& variation : variations()) {
    if (const auto& change = cell.changes[std::size_t(variation.key)]) {
      number(fmt::format("cost_{}", variation.id), change->cost);
      number(fmt::format("error_{}", variation.id), change->error);
    }
  }
}

std::string summary_csv(std::span<const CaseResult> results, const StabilitySummary& summary) {
  std::string csv =
      "case,scene,sampler,subject,role,estimator,policy,terms,thresholds,limit,truth_spp,"
      "truth_noise,metric,value,low,high,visible,verdict\n";
  for (const Cell& cell : summary.cells) {
    for (const CaseResult& result : results) {
      if (result.failure == cell.failure) {
        add_cell(csv, result, cell);
      }
    }
  }
  return csv;
}

/// Of what nothing is wrong with, of what may be, and of what was not run.
constexpr Rgba8 kept_color{65, 134, 88};
constexpr Rgba8 open_color{112, 122, 132};
constexpr Rgba8 empty_color{222, 222, 222};

MatrixFigure::Cell cell_of(const Cell& cell) {
  const Finding& found = cell.deciding();
  const auto text = found.rule->text;
  MatrixFigure::Cell shown;
  shown.text = text(found.effect.mean);
  shown.small = {fmt::format("{} … {}", text(found.effect.low), text(found.effect.high)),
                 fmt::format("{} visible", text(found.visible))};
  shown.color = found.verdict == Verdict::fails  ? found.rule->color
                : found.verdict == Verdict::open ? open_color
                                                 : kept_color;
  return shown;
}

std::string column_of(const Subject& subject) {
  return subject.role == Role::planted ? fmt::format("({})", subject.id) : std::string(subject.id);
}

MatrixFigure::Panel panel_of(const StabilityOptions& options, const StabilitySummary& summary,
                             std::span<const Subject> subjects, Terms terms, std::string title) {
  MatrixFigure::Panel panel{std::move(title), {}};
  for (const FailureCase* failure : options.cases) {
    for (const Subject& subject : subjects) {
      const auto cell = std::ranges::find_if(summary.cells, [&](const Cell& candidate) {
        return candidate.failure == failure && candidate.terms == terms &&
               candidate.subject.id == subject.id;
      });
      panel.cells.push_back(cell == summary.cells.end() ? MatrixFigure::Cell{"", {}, empty_color}
                                                        : cell_of(*cell));
    }
  }
  return panel;
}

MatrixFigure matrix_of(const StabilityOptions& options, std::span<const CaseResult> results,
                       const StabilitySummary& summary, const std::string& command_line) {
  MatrixFigure figure;
  figure.title = "How each estimator fails";
  figure.lines = {fmt::format(
      "Sampler {}, {} seeds, mode reuse; a pixel may have {:g} samples at most. The oracle knows "
      "the "
      "error to expect of each pixel, and has the same budget. Each cell: the first rule that it "
      "breaks, else the first that is open, else its error over that of as many uniform samples; "
      "the "
      "effect, its interval, and the smallest effect that the seeds would have shown with a chance "
      "of 80 %. All {:g} intervals together have {:g} % confidence. Columns in brackets are "
      "mistakes "
      "planted on purpose.",
      sampler_row(options.sampler).id, options.seeds, options.spp * maximum_over_budget,
      summary.confidence.tests, 100.0 * (1.0 - summary.confidence.family))};
  for (const FailureCase* failure : options.cases) {
    figure.rows.push_back(fmt::format("{} ({})", failure->mode, failure->id));
  }
  const std::vector<Subject>& subjects = results.front().subjects;
  for (const Subject& subject : subjects) {
    figure.columns.push_back(column_of(subject));
  }
  figure.panels = {
      panel_of(options, summary, subjects, Terms::budget,
               fmt::format("Policy {}, thresholds at which each takes {:g} samples a pixel in the "
                           "mean, as far as it can",
                           policy(options.policy).id, options.spp)),
      panel_of(options, summary, subjects, Terms::window,
               fmt::format("As the window begins: policy vote, thresholds as they come, {} passes",
                           options.window_passes))};
  for (const Rule& rule : rules()) {
    figure.legend.push_back({rule.color, std::string(rule.label), std::string(rule.sentence)});
  }
  figure.legend.push_back(
      {open_color, "open",
       "No rule is broken for sure, but one may be: its interval holds the limit."});
  figure.legend.push_back(
      {kept_color, "none of these", "The intervals of all rules are within their limits."});
  figure.footer = fmt::format("quartet {} · {}", version(), command_line);
  return figure;
}

}  // namespace

void write_stability_files(StagedFiles& files, const StabilityOptions& options,
                           std::span<const CaseResult> results, const StabilitySummary& summary,
                           const std::string& command_line) {
  const MatrixFigure figure = matrix_of(options, results, summary, command_line);
  write_matrix_png(figure, files.stage("matrix.png"));
  write_matrix_pdf(figure, files.stage("matrix.pdf"));
  files.write("stability.csv", summary_csv(results, summary));
  files.write("trials.csv", trials_csv(results));
}

}  // namespace quartet
