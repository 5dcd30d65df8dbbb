#include "app/options/reference_option.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/options/number_option.h"
#include "app/options/usage_error.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"
#include "app/terminal/progress.h"
#include "renderer/base/printable.h"
#include "renderer/base/stopwatch.h"
#include "renderer/files/exr.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/reference/reference_cache.h"

namespace quartet {
namespace {

/// Enough samples a pass that threads do not wait for each other, few enough that Ctrl-C and the
/// progress bar do not wait for the pass.
std::uint32_t pass_spp(const ReferenceRender& render) {
  constexpr double pass_seconds = 0.5;
  const ReferenceSums& sums = render.sums();
  if (sums.spp == 0 || sums.seconds <= 0.0) {
    return 2;
  }
  const double spp = pass_seconds / (sums.seconds / double(sums.spp));
  return std::uint32_t(std::clamp(spp, 2.0, 65536.0));
}

struct CachedFile {
  std::filesystem::path path;
  ReferenceSums sums;
};

/// The file with most samples that are not too many. What cannot be read is as good as not there.
std::optional<CachedFile> best_cached(const std::array<std::filesystem::path, 2>& paths,
                                      std::uint64_t spp, std::uint64_t seed) {
  std::optional<CachedFile> best;
  for (const std::filesystem::path& path : paths) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
      continue;
    }
    try {
      std::optional<ReferenceSums> sums = sums_of(read_exr(path), path);
      if (sums && sums->settings.seed == seed && sums->spp <= spp &&
          (!best || sums->spp > best->sums.spp)) {
        best = CachedFile{path, std::move(*sums)};
      }
    } catch (const std::exception& error) {
      warn("not used, and made again: {}", error.what());
    }
  }
  return best;
}

void cache(const ReferenceRender& render, const std::filesystem::path& path,
           const std::string& command_line) {
  try {
    StagedFiles files(path.parent_path(), {path.filename().string()});
    write_exr(files.stage(path.filename().string()), exr_of(render.sums(), command_line));
    files.commit([&] { return samples_in(path, render.sums()) <= render.sums().spp; });
  } catch (const std::exception& error) {
    warn("the reference is not cached: {}", error.what());
  }
}

}  // namespace

void add_reference_option(CLI::App& command, ReferenceChoice& choice) {
  CLI::Option* reference =
      command
          .add_option("--reference", choice.path,
                      "What errors are measured against: of quartet reference, or any EXR, PFM, "
                      "HDR or PNG of this size")
          ->type_name("REF.exr");
  command
      .add_option("--reference-layer", choice.layer,
                  "Of an EXR with several layers of colour, e.g. ViewLayer.Combined")
      ->type_name("NAME")
      ->needs(reference);
}

CLI::Option* add_reference_spp_option(CLI::App& command, std::uint32_t& spp) {
  return add_number(command, "--reference-spp", spp, {2, 1u << 30},
                    "Of the reference that is made, and kept, where none is given")
      ->excludes(command.get_option("--reference"));
}

std::shared_ptr<const Reference> reference_at(const ReferenceChoice& choice, const Run& run) {
  if (choice.empty()) {
    return nullptr;
  }
  std::shared_ptr<const Reference> reference = load_reference(choice.path, choice.options());
  check_reference(*reference, run.scene->scene(), run.settings);
  for (const std::string& note : reference->notes) {
    warn("{}: {}", choice.path, note);
  }
  if (!reference->ours()) {
    warn("{} is no reference of Quartet's: whether it shows this scene could not be checked",
         choice.path);
  }
  return reference;
}

std::shared_ptr<const RadianceImage> image_of(const std::shared_ptr<const Reference>& reference) {
  return reference ? std::shared_ptr<const RadianceImage>(reference, &reference->image) : nullptr;
}

std::shared_ptr<const RadianceImage> truth_for(std::span<const LaneSettings> lane_settings,
                                               const std::shared_ptr<const Reference>& reference) {
  for (const LaneSettings& settings : lane_settings) {
    if (const Estimator& row = estimator(settings.estimator); row.needs_reference && !reference) {
      throw UsageError(fmt::format(
          "--reference: estimator '{}' compares with one, and none is given; make it with quartet "
          "reference",
          row.id));
    }
  }
  return image_of(reference);
}

std::shared_ptr<const Reference> chosen_or_made(const ReferenceChoice& choice, const Run& run,
                                                std::uint64_t spp,
                                                const std::string& command_line) {
  std::shared_ptr<const Reference> chosen = reference_at(choice, run);
  return chosen ? chosen : reference_for(run, spp, command_line);
}

bool run_reference(ReferenceRender& render, const ReferenceGoal& goal, int threads,
                   std::stop_token stop) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  Progress progress("reference");
  const Stopwatch watch;
  const std::uint64_t from = render.sums().spp;
  const auto done = [&] {
    double fraction = 0.0;
    if (goal.spp) {
      const std::uint64_t spp = render.sums().spp;
      fraction = spp >= *goal.spp ? 1.0 : double(spp - from) / double(*goal.spp - from);
    }
    return goal.seconds ? std::max(fraction, watch.seconds() / *goal.seconds) : fraction;
  };
  while (done() < 1.0) {
    if (stop.stop_requested()) {
      return false;
    }
    std::uint32_t spp = pass_spp(render);
    if (goal.spp) {
      spp = std::uint32_t(std::min<std::uint64_t>(spp, *goal.spp - render.sums().spp));
    }
    arena.execute([&] { render.add(spp); });
    progress.update(done(), fmt::format("{} spp", render.sums().spp));
  }
  return true;
}

std::shared_ptr<const Reference> reference_for(const Run& run, std::uint64_t spp,
                                               const std::string& command_line) {
  const RenderSettings settings = reference_settings(run.scene->scene(), run.settings);
  ReferenceRender render(run.scene, settings);
  check_reference(*render.reference(), run.scene->scene(), run.settings);
  const std::filesystem::path folder = reference_cache_folder();
  std::filesystem::path exact;
  if (!folder.empty()) {
    // That of the window grows; that of a number of samples stays as it is, so that a command gives
    // the same numbers again.
    const std::filesystem::path growing =
        cached_reference_path(folder, run.scene->scene(), settings);
    exact = growing;
    exact.replace_filename(fmt::format("{}-{}spp.exr", growing.stem().string(), spp));
    if (std::optional<CachedFile> cached = best_cached({exact, growing}, spp, settings.seed)) {
      render.resume(std::move(cached->sums), cached->path);
    }
  }
  if (render.sums().spp < spp) {
    const Interrupt interrupt;
    const bool finished = run_reference(render, {spp, {}}, run.lab.threads, interrupt.token());
    if (!exact.empty()) {
      cache(render, exact, command_line);
    }
    if (!finished) {
      throw Interrupted();
    }
  }
  return render.reference();
}

}  // namespace quartet
