#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/lane_option.h"
#include "app/number_check.h"
#include "app/progress.h"
#include "app/run_options.h"
#include "renderer/image/exr.h"
#include "renderer/image/staged_files.h"
#include "renderer/measure/bias.h"
#include "renderer/measure/interval.h"
#include "renderer/version.h"
#include "ui/figure.h"
#include "ui/lab_figure.h"

namespace quartet {
namespace {

struct BiasOptions {
  RunOptions run;
  LaneOptions lanes;
  std::uint32_t frames = 15;
  std::uint32_t seeds = 16;
  double confidence = 0.99;
  std::string out;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / double(values.size());
}

std::string signed_percent(double share) {
  return fmt::format("{}{:.3f} %", share < 0.0 ? "−" : "+", 100.0 * std::abs(share));
}

/// False-alarm rate of one interval, so that all together keep the confidence.
double each_rate(const BiasOptions& options, std::size_t runs) {
  return sidak(1.0 - options.confidence, double(runs));
}

std::string energy_text(const BiasOptions& options, const BiasRuns& runs, std::size_t count) {
  const Interval energy = mean_interval(runs.energy, each_rate(options, count));
  return fmt::format("{} ± {:.3f} %", signed_percent(energy.mean),
                     100.0 * (energy.high - energy.mean));
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

Figure figure_of(const BiasOptions& options, const std::vector<BiasRuns>& all,
                 const std::string& scene, const Program& program) {
  Figure figure;
  figure.title = fmt::format("Bias in {}: mean of {} runs of {} frames less uniform sampling",
                             scene, options.seeds, options.frames);
  figure.columns = 2;
  const double end = common_end(all);
  figure.shared_bar =
      ColorBar{{-end, end, ColorMapId::coolwarm}, "luminance less that of uniform sampling", ""};
  for (const BiasRuns& runs : all) {
    FigurePanel panel;
    panel.image = DisplayImage(runs.difference.width(), runs.difference.height());
    apply(runs.difference.pixels(), figure.shared_bar->scale, panel.image.pixels());
    panel.title = fmt::format("{}, {}, {}", estimator(runs.policy.estimator).label,
                              threshold_text(runs.policy), sample_use(runs.policy.use).id);
    panel.lines = {
        fmt::format("energy {}", energy_text(options, runs, all.size())),
        fmt::format("{:.1f} spp, {:.2f} s a run", mean_of(runs.mean_spp), mean_of(runs.seconds))};
    figure.panels.push_back(std::move(panel));
  }
  figure.footer = fmt::format("{:g} % intervals, all together · quartet {} · {}",
                              100.0 * options.confidence, version(), program.command_line);
  return figure;
}

std::string thresholds_of(const SamplingPolicy& policy) {
  std::string text;
  for (int c = 0; c < estimator(policy.estimator).channels; ++c) {
    text += fmt::format("{}{}", c > 0 ? " " : "", policy.thresholds[std::size_t(c)]);
  }
  return text;
}

std::string csv_of(const BiasOptions& options, const std::vector<BiasRuns>& all,
                   const std::string& scene, std::uint64_t first_seed) {
  std::string csv =
      "scene,estimator,policy,mode,thresholds,seed,frame,seconds,samples,mean_spp,metric,value\n";
  for (const BiasRuns& runs : all) {
    const std::string lane =
        fmt::format("{},{},{},{},{}", scene, estimator(runs.policy.estimator).id,
                    allocation(runs.policy.allocation.kind).id, sample_use(runs.policy.use).id,
                    thresholds_of(runs.policy));
    const double pixels = double(runs.difference.size());
    for (std::size_t k = 0; k < runs.energy.size(); ++k) {
      csv += fmt::format("{},{},{},{:.6f},{:.0f},{:.6f},energy_less_uniform,{:.9g}\n", lane,
                         first_seed + k, options.frames, runs.seconds[k], runs.mean_spp[k] * pixels,
                         runs.mean_spp[k], runs.energy[k]);
    }
    const Interval energy = mean_interval(runs.energy, each_rate(options, all.size()));
    const auto row = [&](std::string_view metric, double value) {
      csv += fmt::format("{},all,{},{:.6f},{:.0f},{:.6f},{},{:.9g}\n", lane, options.frames,
                         mean_of(runs.seconds), mean_of(runs.mean_spp) * pixels,
                         mean_of(runs.mean_spp), metric, value);
    };
    row("energy_less_uniform", energy.mean);
    row("energy_less_uniform_low", energy.low);
    row("energy_less_uniform_high", energy.high);
    row("energy_p", mean_p(runs.energy, 0.0));
    row("noise", runs.noise);
  }
  return csv;
}

ExrImage exr_of(const std::vector<BiasRuns>& all, const std::string& scene,
                const Program& program) {
  ExrImage exr(all.front().mean.width(), all.front().mean.height());
  exr.add_radiance(all.front().uniform);
  for (const BiasRuns& runs : all) {
    const std::string name =
        fmt::format("{}.{}", estimator(runs.policy.estimator).id, sample_use(runs.policy.use).id);
    const auto plane = [](const ScalarImage& image) {
      return std::vector<float>(image.pixels().begin(), image.pixels().end());
    };
    exr.add("Bias." + name, plane(runs.difference));
    exr.add("BiasError." + name, plane(runs.standard_error));
  }
  exr.attributes = {
      {"scene", scene},
      {"version", std::string(version())},
      {"commandLine", program.command_line},
      {"biasMeaning",
       "R G B: uniform sampling. Bias.*: mean luminance less that of uniform sampling; "
       "BiasError.*: its standard error over the seeds"}};
  return exr;
}

void print_table(const BiasOptions& options, const std::vector<BiasRuns>& all) {
  fmt::print("{:<16} {:<9} {:>9} {:>9}  {:<26} {:>9}\n", "estimator", "mode", "mean spp", "seconds",
             fmt::format("energy ({:g} % interval)", 100.0 * options.confidence), "p");
  for (const BiasRuns& runs : all) {
    fmt::print("{:<16} {:<9} {:>9.2f} {:>9.3f}  {:<26} {:>9.2g}\n",
               estimator(runs.policy.estimator).id, sample_use(runs.policy.use).id,
               mean_of(runs.mean_spp), mean_of(runs.seconds),
               energy_text(options, runs, all.size()), mean_p(runs.energy, 0.0));
  }
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
    fmt::print(
        "{}: mode unbiased takes {:.2f} × the time of reuse, and {:.2f} × for the same noise\n",
        estimator(all[i].policy.estimator).id,
        mean_of(all[i + 1].seconds) / mean_of(all[i].seconds),
        price_of_unbiasedness(all[i], all[i + 1]));
  }
}

void run_bias(const BiasOptions& options, const Program& program) {
  const std::vector<SamplingPolicy> policies = policies_of(options.lanes, options.run);
  const Run run = prepare_run(options.run, 2 * policies.size());
  StagedFiles files(options.out);
  std::vector<BiasRuns> all;
  {
    const Interrupt interrupt;
    Progress progress("measuring bias");
    all = measure_bias(
        run.scene, run.settings, policies, options.frames, options.seeds, run.lab,
        [&](double done) {
          progress.update(
              done, fmt::format("seed {} of {}",
                                std::min(options.seeds, 1 + std::uint32_t(done * options.seeds)),
                                options.seeds));
        },
        interrupt.token());
    if (all.empty()) {
      throw Interrupted();
    }
  }
  const std::string& scene = run.scene->scene().name;
  const Figure figure = figure_of(options, all, scene, program);
  write_figure_png(figure, files.stage("bias.png"));
  write_figure_pdf(figure, files.stage("bias.pdf"));
  write_exr(files.stage("bias.exr"), exr_of(all, scene, program));
  files.write("bias.csv", csv_of(options, all, scene, run.settings.seed));
  files.commit();
  print_table(options, all);
}

}  // namespace

void add_bias_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "bias", "How far off adaptive pictures are on average, and what it costs to be right");
  const auto options = std::make_shared<BiasOptions>();
  add_run_options(*command, options->run);
  add_lane_options(*command, options->lanes);
  command->add_option("--frames", options->frames, "Rounds of sampling of each run")
      ->check(CLI::Range(1u, 1'000'000u))
      ->capture_default_str();
  command->add_option("--seeds", options->seeds, "Independent runs")
      ->check(CLI::Range(2u, 1'000'000u))
      ->capture_default_str();
  command
      ->add_option("--confidence", options->confidence, "Of all intervals together, such as 0.99")
      ->check(number_between(0.5, 0.999999))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the files, made if need be")->required();
  command->footer(
      "Writes bias.png, bias.pdf, bias.exr and bias.csv. Each policy runs in both modes, reuse and "
      "unbiased.\n"
      "Examples:\n"
      "  quartet bias cornell-checker --size 240x135 --seeds 16 --out bias\n"
      "  quartet bias failures/rare-light --policy batch --estimators contrast,kl --out bias");
  command->callback([options, &program] { run_bias(*options, program); });
}

}  // namespace quartet
