#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/options/number_option.h"
#include "app/options/optional_file.h"
#include "app/options/output_check.h"
#include "app/options/reference_option.h"
#include "app/options/run_options.h"
#include "app/records/claims_files.h"
#include "app/records/rejected_report.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"

namespace quartet {
namespace {

struct ClaimsOptions {
  RunOptions run;
  std::uint32_t passes = 15;
  std::uint32_t seeds = 8;
  ReferenceChoice reference;
  std::uint32_t reference_spp = 512;
  bool json = false;
  std::string csv;
};

void run_claims(const ClaimsOptions& options, const Program& program) {
  check_seeds(options.run, options.seeds);
  Run run = prepare_run(options.run, 1);
  run.lab.statistics = {};
  // Before the long part: whether it is the report's scene, and whether the file can be written.
  const std::vector<RegionId> region_of_pixel = find_regions(*run.scene, run.settings);
  OptionalFile csv(options.csv);
  const std::shared_ptr<const Reference> reference =
      chosen_or_made(options.reference, run, options.reference_spp, program.command_line);
  const SampleWorld world = sample_world(run.scene, run.settings, run.lab, image_of(reference));
  std::optional<ClaimData> data;
  {
    const Interrupt interrupt;
    Progress progress("claims");
    data = measure_claims(
        world, region_of_pixel, options.passes, options.seeds, interrupt.token(),
        [&](double done, std::string_view detail) { progress.update(done, detail); });
  }
  if (!data) {
    throw Interrupted();
  }
  const ClaimsReport report{run, *data, options.passes, reference->spp, program.command_line};
  csv.write([&] { return claims_csv(report); });
  fmt::print("{}", options.json ? claims_json(report) : claims_text(report));
  report_rejected(data->rejected, options.run, run.scene, run.settings);
  tell_if_partial(data->partial, options.run);
}

}  // namespace

void add_claims_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "claims", "The findings of the 2021 report on adaptive sampling, measured");
  const auto options = std::make_shared<ClaimsOptions>();
  options->run.size = "960x540";  // the report's own
  // Its lanes are those of the report: nothing of them can be chosen.
  add_scene_options(*command, options->run);
  command->get_option("--size")->description("Picture size; the report's if not given");
  add_threads_option(*command, options->run);
  add_memory_option(*command, options->run);
  command->get_option("scene")->required(false)->capture_default_str()->description(
      "The report's scene, or one with shapes of the same ids");
  add_number(*command, "--passes,--frames", options->passes, {1, 10'000}, "Passes of each run");
  add_seeds_option(*command, options->seeds);
  add_reference_option(*command, options->reference);
  add_reference_spp_option(*command, options->reference_spp);
  command->add_flag("--json", options->json, "Print JSON instead of tables");
  command->add_option("--csv", options->csv, "Write the measured numbers to a file, too")
      ->type_name("FILE.csv");
  command->footer(
      "Where each criterion puts its samples, by region; each finding in the report's words, with "
      "comparisons that\nhold or do not; and whether any criterion beats uniform sampling at equal "
      "time. At the report's size, passes and\nluminance weights. Intervals are 95 %, over the "
      "seeds; those of all findings hold together.\n"
      "Examples:\n"
      "  quartet claims\n"
      "  quartet claims --size 480x270 --seeds 10 --csv claims.csv");
  command->callback([options, &program] { run_claims(*options, program); });
}

}  // namespace quartet
