#include "app/records/stability_files.h"

#include <fmt/format.h>

#include <cmath>

#include "app/records/run_record.h"
#include "renderer/base/version.h"
#include "ui/paper/matrix_figure.h"

namespace quartet {
namespace {

std::string_view id_of(Tuning tuning) {
  return tuning == Tuning::usual ? "default" : "budget";
}

std::string trials_csv(const StabilityOptions& options, std::span<const CaseResult> results) {
  std::string csv =
      "case,scene,sampler,estimator,policy,mode,tuning,variation,thresholds,seed,pass,seconds,rays,"
      "samples,"
      "mean_spp,metric,value\n";
  for (const CaseResult& result : results) {
    for (const Trial& trial : result.trials) {
      const Outcome& outcome = trial.outcome;
      const double pixels = double(result.width) * double(result.height) *
                            (trial.variation == Variation::resolution ? 4.0 : 1.0);
      const std::string row =
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{:.6f},{:.0f},{:.0f},{:.6f}",
                      result.failure->id, result.failure->scene, sampler_row(result.sampler).id,
                      estimator(trial.settings.estimator).id, policy(options.policy).id,
                      sample_mode(trial.settings.mode).id, id_of(trial.tuning),
                      variations()[std::size_t(trial.variation)].id,
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

/// Rows "…,metric,value,low,high,p" of one cell.
void add_cell(std::string& csv, const StabilityOptions& options, const CaseResult& result,
              const Cell& cell) {
  const std::string row =
      fmt::format("{},{},{},{},{},{},{},{:g},{:g}", cell.failure->id, cell.failure->scene,
                  sampler_row(result.sampler).id, estimator(cell.settings.estimator).id,
                  policy(options.policy).id, id_of(cell.tuning), thresholds_text(cell.settings),
                  double(result.truth.spp), result.truth.noise);
  const auto number = [&](std::string_view metric, double value) {
    csv += fmt::format("{},{},{:.9g},,,\n", row, metric, value);
  };
  const auto interval = [&](std::string_view metric, const Interval& value) {
    csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},\n", row, metric, value.mean, value.low,
                       value.high);
  };
  const auto test = [&](std::string_view metric, const BiasTest& value) {
    csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.4g}\n", row, metric, value.off.mean,
                       value.off.low, value.off.high, value.p);
  };
  csv += fmt::format("{},verdict,{},,,\n", row, cell_verdict(cell).id);
  test("bias", cell.picture);
  test("region_bias", cell.region);
  test("unbiased_bias", cell.unbiased_picture);
  test("unbiased_region_bias", cell.unbiased_region);
  for (std::size_t i = 0; i < outcome_columns().size(); ++i) {
    interval(outcome_columns()[i].id, cell.values[i]);
  }
  interval("missed_by_audit", cell.audit);
  number("audited", cell.audited);
  interval("equal_time_error", cell.equal_time);
  number("price_of_unbiased", cell.price);
  number("cost_spread", cell.cost_spread);
  number("error_spread", cell.error_spread);
  for (const VariationRow& variation : variations()) {
    if (const auto& change = cell.changes[std::size_t(variation.key)]) {
      number(fmt::format("cost_{}", variation.id), change->cost);
      number(fmt::format("error_{}", variation.id), change->error);
    }
  }
}

std::string summary_csv(const StabilityOptions& options, std::span<const CaseResult> results,
                        const StabilitySummary& summary) {
  std::string csv =
      "case,scene,sampler,estimator,policy,tuning,thresholds,truth_spp,truth_noise,metric,value,"
      "low,high,"
      "p\n";
  for (const Cell& cell : summary.cells) {
    for (const CaseResult& result : results) {
      if (result.failure == cell.failure) {
        add_cell(csv, options, result, cell);
      }
    }
  }
  return csv;
}

MatrixFigure matrix_of(const StabilityOptions& options, const StabilitySummary& summary,
                       const std::string& command_line) {
  MatrixFigure figure;
  figure.title = "How each estimator fails";
  figure.lines = {fmt::format(
      "Policy {}, sampler {}, {} seeds, mode reuse. A pixel is wrong if its squared relative error "
      "(x − r)² / (r² + 0.01) is above {:g}; it may have {:g} samples at most. Each "
      "cell is the first verdict of the list whose rule holds, with the number that "
      "decided; intervals have {:g} % confidence, all together.",
      policy(options.policy).id, sampler_row(options.sampler).id, options.seeds, options.target,
      options.spp * maximum_over_budget, 100.0 * (1.0 - summary.confidence.family))};
  for (const FailureCase* failure : options.cases) {
    figure.rows.push_back(fmt::format("{} ({})", failure->mode, failure->id));
  }
  for (const EstimatorId id : options.estimators) {
    figure.columns.emplace_back(estimator(id).id);
  }
  figure.panels = {
      {"Thresholds as they come", {}},
      {fmt::format("Thresholds at which each takes {:g} samples a pixel in the mean, as far as it "
                   "can",
                   options.spp),
       {}}};
  for (const Cell& cell : summary.cells) {
    const CellVerdict& row = cell_verdict(cell);
    figure.panels[cell.tuning == Tuning::usual ? 0 : 1].cells.push_back(
        {row.number(cell), row.color});
  }
  for (const CellVerdict& row : cell_verdicts()) {
    figure.legend.push_back({row.color, std::string(row.label), std::string(row.rule)});
  }
  figure.footer = fmt::format("quartet {} · {}", version(), command_line);
  return figure;
}

}  // namespace

void write_stability_files(StagedFiles& files, const StabilityOptions& options,
                           std::span<const CaseResult> results, const StabilitySummary& summary,
                           const std::string& command_line) {
  const MatrixFigure figure = matrix_of(options, summary, command_line);
  write_matrix_png(figure, files.stage("matrix.png"));
  write_matrix_pdf(figure, files.stage("matrix.pdf"));
  files.write("stability.csv", summary_csv(options, results, summary));
  files.write("trials.csv", trials_csv(options, results));
}

}  // namespace quartet
