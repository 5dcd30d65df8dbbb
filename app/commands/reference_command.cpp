#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/options/number_option.h"
#include "app/options/output_check.h"
#include "app/options/reference_option.h"
#include "app/options/usage_error.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"
#include "renderer/files/exr.h"
#include "renderer/files/staged_files.h"

namespace quartet {
namespace {

struct ReferenceOptions {
  RunOptions run;
  ReferenceGoal goal;
  bool restart = false;
  std::string output;
};

/// One that could be written but not read again would be of no use.
void check_reference_size(const RenderSettings& settings, const std::filesystem::path& path) {
  constexpr std::size_t channels = 19;
  constexpr double most = 14e6;  // pixels; each has 19 numbers, and read_exr takes 2^28
  if (double(settings.width) * double(settings.height) > most) {
    throw UsageError(
        fmt::format("--size: {}x{} is too large for a reference; up to 14 million "
                    "pixels are possible",
                    settings.width, settings.height));
  }
  check_picture_size("--size", settings.width, settings.height, path, channels);
}

/// Goes on with the file, if there is one.
void resume_from(const std::filesystem::path& path, ReferenceRender& render) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return;
  }
  std::optional<ReferenceSums> sums = sums_of(read_exr(path), path);
  if (!sums) {
    throw std::runtime_error(
        fmt::format("{} is there and no reference of Quartet's; choose another name, or give "
                    "--restart to replace it",
                    path.string()));
  }
  render.resume(std::move(*sums), path);
}

void print_summary(const std::filesystem::path& path, const ReferenceRender& render,
                   std::uint64_t before) {
  const auto reference = render.reference();
  fmt::print(
      "{}: {} spp, {} of them new, {:.2f} s; noise floor: relMSE {:.3g}, MSE {:.3g}, FLIP "
      "{:.3g}\n",
      path.string(), reference->spp, reference->spp - before, render.sums().seconds,
      reference->noise_floor(MetricId::relmse), reference->noise_floor(MetricId::mse),
      reference->noise_floor(MetricId::flip));
  if (reference->rejected > 0) {
    warn("{} samples rejected (negative or not finite)", reference->rejected);
  }
}

/// Into the file, unless another run has put more of the same samples there meanwhile.
bool keep(const ReferenceSums& sums, const ReferenceOptions& options, const Program& program,
          StagedFiles& files) {
  const std::filesystem::path output = options.output;
  std::uint64_t there = 0;
  const bool kept = files.finish(
      [&] {
        write_exr(files.stage(output.filename().string()), exr_of(sums, program.command_line));
      },
      [&] {
        there = options.restart ? 0 : samples_in(output, sums);
        return there <= sums.spp;
      });
  if (!kept) {
    tell("{} has {} spp by now, of another run; the {} of this one are among them", output.string(),
         there, sums.spp);
  }
  return kept;
}

void run_reference_command(const ReferenceOptions& options, const Program& program) {
  const std::filesystem::path output = options.output;
  if (output.extension() != ".exr") {
    throw UsageError(fmt::format("-o: '{}' is no .exr", options.output));
  }
  if (!options.goal.spp && !options.goal.seconds) {
    throw UsageError("how long? give --spp, such as --spp 4096, or --seconds");
  }
  const Run run = prepare_run(options.run, 1);
  check_reference_size(run.settings, output);
  ReferenceRender render(run.scene, run.settings);
  if (!options.restart) {
    resume_from(output, render);
  }
  StagedFiles files(output.parent_path(), {output.filename().string()});
  const std::uint64_t before = render.sums().spp;
  bool finished = false;
  {
    const Interrupt interrupt;
    finished = run_reference(render, options.goal, run.lab.threads, interrupt.token());
  }
  const bool kept = render.sums().spp == before || keep(render.sums(), options, program, files);
  if (!finished && render.sums().spp < 2) {
    throw Interrupted();
  }
  if (!finished) {
    throw std::runtime_error(
        fmt::format("interrupted; {} holds the {} spp that were done, and the same command goes on",
                    output.string(), render.sums().spp));
  }
  if (kept) {
    print_summary(output, render, before);
  }
}

}  // namespace

void add_reference_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "reference", "The truth to compare with: many samples, the same number in every pixel");
  const auto options = std::make_shared<ReferenceOptions>();
  options->run.seed = reference_seed;
  add_scene_options(*command, options->run);
  add_threads_option(*command, options->run);
  add_number(*command, "--spp", options->goal.spp, {2, 4'000'000'000},
             "Samples per pixel in all, those of earlier runs included");
  add_number(*command, "--seconds", options->goal.seconds, above_zero<double>,
             "Stop after so much time, earlier runs not counted");
  command->add_flag("--restart", options->restart,
                    "Replace a file that is there instead of going on with it");
  command->add_option("-o,--output", options->output, "An .exr")->required();
  command->footer(
      "Two halves with random numbers of their own tell how far the reference itself is off: its\n"
      "noise floor, in the header. The default seed differs from that of experiments.\n"
      "If the file is there, samples are added to it, and it ends to the bit as if made at once.\n"
      "Ctrl-C ends after the samples at hand, a second or so, and keeps what is done: the same\n"
      "command goes on. A second Ctrl-C leaves the file as it was.\n"
      "Examples:\n"
      "  quartet reference cornell-checker --size 480x270 --spp 4096 -o ref.exr\n"
      "  quartet reference veach-plates --seconds 600 --integrator kajiya -o plates.exr");
  command->callback([options, &program] { run_reference_command(*options, program); });
}

}  // namespace quartet
