#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/options/add_once.h"
#include "app/options/number_option.h"
#include "app/options/optional_file.h"
#include "app/options/run_options.h"
#include "app/options/usage_error.h"
#include "app/records/needs_files.h"
#include "app/records/rejected_report.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "renderer/base/table.h"
#include "renderer/measure/stop_conditions.h"
#include "renderer/scene/synthetic.h"

namespace quartet {
namespace {

constexpr NumberRange<std::uint32_t> spp_of_picture{1, 65536};

struct NeedsOptions {
  RunOptions run;
  NeedsPlan plan;
  std::vector<std::string> parts;  // none: all
  std::string error;
  std::string metric{quartet::metric(NeedsPlan().metric).id};
  std::string csv;
  std::string out;
  bool json = false;
};

NeedsPlan needs_plan(const NeedsOptions& options) {
  NeedsPlan plan = options.plan;
  std::string_view given = "--metric";
  plan.metric = find_metric(options.metric).key;
  if (!options.error.empty()) {
    given = "--error";
    try {
      const ErrorTarget target = parse_error_target(options.error);
      plan.metric = target.metric;
      plan.error = target.value;
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--error: {}", error.what()));
    }
  }
  if (const Metric& row = metric(plan.metric); row.scale == MetricScale::decibels) {
    throw UsageError(
        fmt::format("{}: noise cannot be told apart from an error in {}; mse would say the same",
                    given, row.unit));
  }
  for (const std::string& id : options.parts) {
    add_once(plan.parts, find_part(id).key);
  }
  for (const Part& row : parts()) {
    if (options.parts.empty()) {
      plan.parts.push_back(row.key);
    }
  }
  return plan;
}

/// What was named and is not there to be taken out would do nothing.
void check_parts(const NeedsOptions& options, const NeedsPlan& plan, const Model& whole) {
  if (synthetic_of(whole.scene) != nullptr) {
    throw UsageError(fmt::format(
        "'{}' draws its samples: it has no parts to take out; a scene that is traced would be "
        "right",
        whole.scene.name));
  }
  for (const PartId id : plan.parts) {
    if (!options.parts.empty() && part(id).of(whole).empty()) {
      throw UsageError(fmt::format(
          "--parts: '{}' has no effect: there is nothing of the kind in '{}' to take out",
          part(id).id, whole.scene.name));
    }
  }
}

/// What to do about a whole model that is further off than was asked for.
std::string cannot_be_met(const NeedsPlan& plan, const NeedsResult& result) {
  const Metric& row = metric(plan.metric);
  const double times = result.noise_floor.mean / *plan.error;
  const double spp = plan.spp * (row.scale == MetricScale::squared_error ? times : times * times);
  const std::string advice =
      spp <= spp_of_picture.high
          ? fmt::format("about --spp {:.0f} would bring it there", std::ceil(spp))
          : fmt::format("a larger error would be right, or {:.2g} times the samples",
                        spp / plan.spp);
  return fmt::format(
      "--error {}={:g} cannot be met: the whole model's own noise, of {} seeds of {} spp, is "
      "{:.4g}; {}",
      row.id, *plan.error, plan.seeds, plan.spp, result.noise_floor.mean, advice);
}

void run_needs_command(const NeedsOptions& options, const Program& program) {
  const NeedsPlan plan = needs_plan(options);
  check_seeds(options.run, plan.seeds);
  // Two models' pictures at a time, which take less than as many lanes.
  const Run run = prepare_run(options.run, (plan.seeds + 3) / 4);
  const Model whole = model_of(run.scene->scene(), run.settings);
  check_parts(options, plan, whole);
  std::optional<StagedFiles> files;
  if (!options.out.empty()) {
    files.emplace(options.out, needs_file_names());
  }
  OptionalFile csv(options.csv);
  std::optional<NeedsResult> result;
  {
    const Interrupt interrupt;
    Progress progress("needs");
    tbb::task_arena arena(run.lab.threads > 0 ? run.lab.threads : tbb::task_arena::automatic);
    arena.execute([&] {
      result =
          run_needs(whole, run.settings.seed, plan, interrupt.token(),
                    [&](double done, std::string_view detail) { progress.update(done, detail); });
    });
  }
  if (!result) {
    throw Interrupted();
  }
  if (!result->can_be_met) {
    throw std::runtime_error(cannot_be_met(plan, *result));
  }
  const NeedsReport report{run, plan, *result, program.command_line};
  csv.write([&] { return needs_csv(report); });
  if (files) {
    files->finish([&] { write_needs_files(*files, report); });
  }
  if (options.json) {
    fmt::print("{}\n", needs_json(report));
  } else {
    fmt::print("{}", needs_text(report));
    if (files) {
      fmt::print("It is {}, with needs as .csv, .json, .png, .pdf and .svg beside it.\n",
                 (std::filesystem::path(options.out) / "smallest.xml").string());
    }
  }
  report_rejected(result->rejected, options.run, run.scene, run.settings);
}

}  // namespace

void add_needs_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "needs", "Which parts of its model a picture needs: each taken out, and what that saves");
  const auto options = std::make_shared<NeedsOptions>();
  add_scene_options(*command, options->run);
  add_threads_option(*command, options->run);
  CLI::Option* const error =
      command
          ->add_option("--error", options->error,
                       "What a smaller model's picture may be off, such as relmse=0.01; as "
                       "much as the whole model's own noise if not given")
          ->type_name("METRIC=VALUE");
  command->add_option("--metric", options->metric, "Of that noise: see quartet list")
      ->capture_default_str()
      ->excludes(error);
  command
      ->add_option("--parts", options->parts,
                   fmt::format("That may be taken out, separated by commas: {}; all that the scene "
                               "has if not given",
                               row_ids(parts())))
      ->delimiter(',');
  add_number(*command, "--spp", options->plan.spp, spp_of_picture,
             "Samples per pixel of a picture");
  add_seeds_option(*command, options->plan.seeds, least_seeds);
  add_number(*command, "--confidence", options->plan.confidence, confidence_range,
             "Of the intervals of all models together, such as 0.95");
  command->add_option("--csv", options->csv, "Write every number as a .csv");
  command->add_option("--out", options->out,
                      "Folder for the chart, the numbers and the smallest model as a scene file");
  command->add_flag("--json", options->json, "Print JSON instead of a table");
  std::string footer = "What is taken out, one after the other:\n";
  for (const Part& row : parts()) {
    footer += fmt::format("  {:<11} {}\n", row.id, row.description);
  }
  command->footer(
      footer +
      "Each model is rendered with the same seeds. Its error is that of the mean picture over all "
      "of "
      "them against\nthe whole model's, less what is noise in their difference. The noise floor is "
      "the error that the whole\nmodel's mean has itself; what lies under it is not needed. All "
      "that is not needed alone is then taken out\ntogether, in the order of rays saved per error, "
      "as long as the error of all is below the limit: the\nsmallest model. Depths are tried "
      "until one is off by less than a hundredth of the limit. The exit\nstatus is 1 if the whole "
      "model's own noise is above --error.\n"
      "Examples:\n"
      "  quartet needs cornell-checker --size 240x135\n"
      "  quartet needs thin-lens --size 300x200 --error flip=0.1 --out needs");
  command->callback([options, &program] { run_needs_command(*options, program); });
}

}  // namespace quartet
