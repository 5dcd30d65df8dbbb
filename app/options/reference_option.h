#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "app/options/run_options.h"
#include "renderer/measure/reference/reference.h"
#include "renderer/measure/reference/reference_render.h"

namespace quartet {

/// A picture that errors are measured against, as the command line names it.
struct ReferenceChoice {
  std::string path;
  std::string layer;  ///< of an EXR; empty: the only one of colour

  bool empty() const { return path.empty(); }
  PictureOptions options() const { return {layer, "--reference-layer"}; }
};

/// Adds --reference PICTURE and --reference-layer.
void add_reference_option(CLI::App& command, ReferenceChoice& choice);
/// Adds --reference-spp, of one that is made where none is given, to a command with --reference.
CLI::Option* add_reference_spp_option(CLI::App& command, std::uint32_t& spp);

/// The reference that was chosen, which fits the run. Of one that another program made, whose scene
/// cannot be checked, notes go to stderr. Null if none was chosen; throws std::runtime_error with
/// the reason if it does not fit.
std::shared_ptr<const Reference> reference_at(const ReferenceChoice& choice, const Run& run);

/// Its picture, which shares its life; null for null.
std::shared_ptr<const RadianceImage> image_of(const std::shared_ptr<const Reference>& reference);

/// The same, for lanes that may look at it: throws UsageError where one of them must and there is
/// none.
std::shared_ptr<const RadianceImage> truth_for(std::span<const LaneSettings> lane_settings,
                                               const std::shared_ptr<const Reference>& reference);

/// A reference for the run with exactly so many samples a pixel: the cached one, else it is made,
/// with a progress bar, and cached. What is interrupted is cached too, and gone on with next time.
/// Throws std::runtime_error. Must not be called while an Interrupt lives.
std::shared_ptr<const Reference> reference_for(const Run& run, std::uint64_t spp,
                                               const std::string& command_line);

/// The one that was chosen, else one for the run with so many samples: both as above.
std::shared_ptr<const Reference> chosen_or_made(const ReferenceChoice& choice, const Run& run,
                                                std::uint64_t spp, const std::string& command_line);

/// How far a reference is to be taken: the first that is met ends it.
struct ReferenceGoal {
  std::optional<std::uint64_t> spp;  ///< in all
  std::optional<double> seconds;     ///< from now on
};

/// Adds samples, pass by pass, on so many threads (0: one a processor), with a progress bar, until
/// the goal is met or, after a whole pass, `stop` asked for it. Returns whether the goal was met.
bool run_reference(ReferenceRender& render, const ReferenceGoal& goal, int threads,
                   std::stop_token stop);

}  // namespace quartet
