#include "app/records/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "app/records/interval_text.h"
#include "renderer/measure/top_share.h"

namespace quartet {
namespace {

/// "0.1538 ± 0.021": Student's intervals are as long on both sides.
std::string plus_minus_text(const Interval& value) {
  const double half = value.high - value.mean;
  return std::isfinite(half) ? fmt::format("{:.4g} ±{:.2g}", value.mean, half)
                             : fmt::format("{:.4g}", value.mean);
}

std::string signed_text(const Interval& share) {
  if (std::isnan(share.mean)) {
    return "–";
  }
  const double half = 100.0 * (share.high - share.mean);
  return std::isfinite(half) ? fmt::format("{:+.2f} ±{:.2f} %", 100.0 * share.mean, half)
                             : fmt::format("{:+.2f} %", 100.0 * share.mean);
}

std::string number_or_dash(double value) {
  return std::isnan(value) ? "–" : fmt::format("{:.3g}", value);
}

std::string row_text(const SweepSummary& summary, std::string_view label, std::string_view factor,
                     const SweepPoint& point, std::string_view note) {
  return fmt::format(
      "{:<22} {:>6} {:>8.2f} {:>8.3f} {:>17} {:>15} {:>10} {:>10} {:>24} {:>5}  {}\n", label,
      factor, point.mean_spp, point.seconds, plus_minus_text(point.error),
      signed_text(point.energy), number_or_dash(point.parts.squared_bias),
      number_or_dash(point.parts.variance),
      ratio_text(point.against_uniform[std::size_t(summary.counted())]),
      top_share_text(point.relmse_top), note);
}

double gain(const SweepSummary& summary, const SweepLine& line) {
  return line.end().against_uniform[std::size_t(summary.counted())].mean;
}

/// The rows of the lines [begin, end), which have one estimator.
std::string estimator_rows(const SweepSummary& summary, std::size_t begin, std::size_t end) {
  const SweepLine* usual = nullptr;
  const SweepLine* best = nullptr;
  const SweepLine* twin = nullptr;
  for (std::size_t i = begin; i < end; ++i) {
    const SweepLine& line = summary.lines[i];
    if (line.lane.twin) {
      twin = line.lane.factor == 1.0 ? &line : twin;
      continue;
    }
    usual = line.lane.factor == 1.0 ? &line : usual;
    best = best == nullptr || gain(summary, line) < gain(summary, *best) ? &line : best;
  }
  const auto row = [&](const SweepLine& line, std::string_view label, std::string_view note) {
    return row_text(summary, label, fmt::format("{:.3g}", line.lane.factor), line.end(), note);
  };
  const Estimator& estimator = quartet::estimator(usual->lane.settings.estimator);
  const std::string_view role = role_of(usual->lane);
  std::string text =
      row(*usual, estimator.label, is_method(usual->lane) ? "at its default threshold" : role);
  if (gain(summary, *best) < gain(summary, *usual)) {
    text += row(*best, "", "at the best of the sweep");
  }
  if (twin != nullptr) {
    text += row(*twin, "", role_of(twin->lane));
  }
  return text;
}

/// Uniform sampling at the first point that has taken as many samples as the baseline that is
/// clamped, and at its last.
std::string uniform_rows(const SweepSummary& summary) {
  const SweepLine& uniform = summary.uniform;
  std::string text;
  for (const SweepLine& line : summary.lines) {
    if (line.lane.settings.estimator == EstimatorId::uniform_clamp) {
      const auto same = std::ranges::find_if(uniform.points, [&](const SweepPoint& point) {
        return point.mean_spp >= line.end().mean_spp;
      });
      if (same != uniform.points.end() && &*same != &uniform.end()) {
        text += row_text(summary, "uniform", "", *same, role_of(uniform.lane));
      }
    }
  }
  return text + row_text(summary, text.empty() ? "uniform" : "", "", uniform.end(),
                         "baseline, where it ends");
}

}  // namespace

std::string sweep_table(const SweepSummary& summary) {
  const Metric& row = metric(summary.metric);
  const std::string parts =
      summary.parts_metric == nullptr || summary.parts_metric->key == summary.metric
          ? std::string(row.id)
          : std::string(summary.parts_metric->id);
  std::string text = fmt::format(
      "± and brackets: {:g} % intervals over {} seed{}, each by itself. energy: mean luminance "
      "over "
      "the reference's, less 1.\nbias² and variance: the two parts of {}. of uniform: the error "
      "over that of uniform sampling run to as many\n{}; below 1 the estimator gains, if its "
      "energy "
      "is right. top: of relMSE, what sits in a thousandth of the pixels.\n\n",
      100.0 * sweep_confidence, summary.seeds, summary.seeds == 1 ? "" : "s", parts,
      summary.is_traced() ? "rays" : "samples");
  text += fmt::format("{:<22} {:>6} {:>8} {:>8} {:>17} {:>15} {:>10} {:>10} {:>24} {:>5}\n",
                      "estimator", "factor", "mean spp", "seconds", row.id, "energy", "bias²",
                      "variance", "of uniform", "top");
  for (std::size_t begin = 0; begin < summary.lines.size();) {
    const EstimatorId id = summary.lines[begin].lane.settings.estimator;
    std::size_t end = begin;
    while (end < summary.lines.size() && summary.lines[end].lane.settings.estimator == id) {
      ++end;
    }
    text += estimator_rows(summary, begin, end);
    begin = end;
  }
  return text + uniform_rows(summary);
}

}  // namespace quartet
