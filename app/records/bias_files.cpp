#include "app/records/bias_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/records/csv_field.h"
#include "app/records/run_record.h"
#include "renderer/base/interval.h"
#include "renderer/base/version.h"
#include "renderer/files/exr.h"
#include "renderer/measure/energy.h"
#include "ui/paper/figure.h"
#include "ui/paper/lab_figure.h"

namespace quartet {
namespace {

std::string signed_percent(double share) {
  return fmt::format("{}{:.3f} %", share < 0.0 ? "−" : "+", 100.0 * std::abs(share));
}

/// False-alarm rate of one interval, so that all together keep the confidence.
double each_rate(const BiasReport& report) {
  return sidak(1.0 - report.confidence, double(report.runs.size()));
}

/// The number above all but one in twenty of the absolute values, for a scale that fireflies do not
/// stretch.
double common_end(const std::vector<BiasRuns>& all) {
  std::vector<float> sizes;
  for (const BiasRuns& runs : all) {
    for (const float number : runs.difference.pixels()) {
      sizes.push_back(std::abs(number));
    }
  }
  const auto place = sizes.begin() + std::ptrdiff_t(sizes.size() - 1 - sizes.size() / 20);
  std::ranges::nth_element(sizes, place);
  if (!(*place > 0.0f)) {
    return 1.0;
  }
  const double digit = std::pow(10.0, std::floor(std::log10(double(*place))) - 1.0);
  return std::ceil(double(*place) / digit) * digit;
}

Figure figure_of(const BiasReport& report) {
  Figure figure;
  figure.title = fmt::format("Bias in {}: mean of {} runs of {} passes less uniform sampling",
                             report.run.scene->scene().name, report.runs.front().seconds.size(),
                             report.passes);
  figure.columns = 2;
  const double end = common_end(report.runs);
  figure.shared_bar =
      ColorBar{{-end, end, ColorMapId::coolwarm}, "luminance less that of uniform sampling", ""};
  for (const BiasRuns& runs : report.runs) {
    FigurePanel panel;
    panel.image = DisplayImage(runs.difference.width(), runs.difference.height());
    apply(runs.difference.pixels(), figure.shared_bar->scale, panel.image.pixels());
    panel.title = fmt::format("{}, {}, {}", estimator(runs.settings.estimator).label,
                              threshold_text(runs.settings), sample_mode(runs.settings.mode).id);
    panel.lines = {
        fmt::format("energy {}", energy_text(report, runs)),
        fmt::format("{:.1f} spp, {:.2f} s a run", mean_of(runs.mean_spp), mean_of(runs.seconds))};
    figure.panels.push_back(std::move(panel));
  }
  figure.footer = fmt::format("{:g} % intervals, all together · quartet {} · {}",
                              100.0 * report.confidence, version(), report.command_line);
  return figure;
}

std::string csv_of(const BiasReport& report) {
  std::string csv(csv_header);
  for (const BiasRuns& runs : report.runs) {
    const std::string lane =
        fmt::format("{},{},{},{},{},{}", csv_field(report.run.scene->scene().name),
                    sampler_row(report.run.settings.sampler).id,
                    estimator(runs.settings.estimator).id, policy(runs.settings.policy.kind).id,
                    sample_mode(runs.settings.mode).id, thresholds_text(runs.settings));
    const double pixels = double(runs.difference.size());
    for (std::size_t k = 0; k < runs.seconds.size(); ++k) {
      csv += fmt::format("{},{},{},{:.6f},{:.0f},{:.0f},{:.6f},energy_less_uniform,{:.9g}\n", lane,
                         report.run.settings.seed + k, report.passes, runs.seconds[k],
                         runs.mean_rays[k] * pixels, runs.mean_spp[k] * pixels, runs.mean_spp[k],
                         energy_error(runs.luminance[k], runs.uniform_luminance[k]));
    }
    const std::vector<double> energies = energies_less_uniform(runs);
    const Interval energy = mean_interval(energies, each_rate(report));
    const auto row = [&](std::string_view metric, double value) {
      csv += fmt::format("{},all,{},{:.6f},{:.0f},{:.0f},{:.6f},{},{:.9g}\n", lane, report.passes,
                         mean_of(runs.seconds), mean_of(runs.mean_rays) * pixels,
                         mean_of(runs.mean_spp) * pixels, mean_of(runs.mean_spp), metric, value);
    };
    row("energy_less_uniform", energy.mean);
    row("energy_less_uniform_low", energy.low);
    row("energy_less_uniform_high", energy.high);
    row("energy_p", mean_p(energies, 0.0));
    row("noise", runs.noise);
  }
  return csv;
}

ExrImage exr_of(const BiasReport& report) {
  const RadianceImage& uniform = report.runs.front().uniform;
  ExrImage exr(uniform.width(), uniform.height());
  exr.add_radiance(uniform);
  std::map<std::string, int> named;
  for (const BiasRuns& runs : report.runs) {
    std::string name = fmt::format("{}.{}", estimator(runs.settings.estimator).id,
                                   sample_mode(runs.settings.mode).id);
    // Several lanes may have the same estimator at other thresholds.
    if (const int before = named[name]++; before > 0) {
      name += fmt::format("-{}", before + 1);
    }
    const auto plane = [](const ScalarImage& image) {
      return std::vector<float>(image.pixels().begin(), image.pixels().end());
    };
    exr.add("Bias." + name, plane(runs.difference));
    exr.add("BiasError." + name, plane(runs.standard_error));
  }
  exr.attributes = {
      {"scene", report.run.scene->scene().name},
      {"sampler", std::string(sampler_row(report.run.settings.sampler).id)},
      {"version", std::string(version())},
      {"commandLine", report.command_line},
      {"biasMeaning",
       "R G B: uniform sampling. Bias.*: mean luminance less that of uniform sampling; "
       "BiasError.*: its standard error over the seeds"}};
  return exr;
}

}  // namespace

std::string energy_text(const BiasReport& report, const BiasRuns& runs) {
  const Interval energy = mean_interval(energies_less_uniform(runs), each_rate(report));
  return fmt::format("{} ± {:.3f} %", signed_percent(energy.mean),
                     100.0 * (energy.high - energy.mean));
}

void write_bias_files(StagedFiles& files, const BiasReport& report) {
  const Figure figure = figure_of(report);
  write_figure_png(figure, files.stage("bias.png"));
  write_figure_pdf(figure, files.stage("bias.pdf"));
  write_exr(files.stage("bias.exr"), exr_of(report));
  files.write("bias.csv", csv_of(report));
}

}  // namespace quartet
