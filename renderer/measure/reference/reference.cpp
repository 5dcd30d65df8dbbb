#include "renderer/measure/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "renderer/files/exr.h"
#include "renderer/files/picture.h"
#include "renderer/measure/left_out.h"
#include "renderer/measure/reference/noise_floors.h"
#include "renderer/measure/reference/reference_sums.h"

namespace quartet {

namespace {

std::string depth_text(int max_depth) {
  return max_depth == std::numeric_limits<int>::max() ? "unlimited depth"
                                                      : fmt::format("depth {}", max_depth);
}

/// Why the reference is not of this run; empty if nothing speaks against it.
std::string mismatch(const Reference& reference, const Scene& scene,
                     const RenderSettings& settings) {
  const RenderSettings& made = reference.settings;
  if (made.width != settings.width || made.height != settings.height) {
    return fmt::format("it has {}x{} pixels, the run has {}x{}", made.width, made.height,
                       settings.width, settings.height);
  }
  if (!reference.ours()) {
    return "";
  }
  const std::string hash = scene_hash(scene);
  if (reference.scene_hash != hash) {
    return fmt::format("it shows '{}' as of hash {}, the run shows '{}' of hash {}",
                       reference.scene_name, reference.scene_hash, scene.name, hash);
  }
  if (std::string reason = why_not(scene, made.integrator); !reason.empty()) {
    return reason;
  }
  if (made.camera != settings.camera) {
    return "it was seen by another camera";
  }
  if (made.max_depth != settings.max_depth) {
    return fmt::format("it was made with {}, the run has {}", depth_text(made.max_depth),
                       depth_text(settings.max_depth));
  }
  const auto seeds = half_seeds(made.seed);
  if (made.sampler == settings.sampler && std::ranges::find(seeds, settings.seed) != seeds.end()) {
    return fmt::format(
        "it is made of the same random numbers as the run, seed {}, and would call their noise "
        "right",
        settings.seed);
  }
  return "";
}

/// An error that leaves pixels out here and there is one of other pixels in each lane and at each
/// pass, and what an oracle does not know it cannot decide.
void require_whole(const Picture& picture, const std::filesystem::path& path) {
  if (picture.uncovered() > 0) {
    throw std::runtime_error(fmt::format(
        "{}: {} of its {}x{} pixels are outside of what it covers, {}x{} at ({}, {}); a "
        "reference with all pixels would be right (quartet compare leaves them out)",
        path.string(), picture.uncovered(), picture.width, picture.height, picture.image.width(),
        picture.image.height(), picture.left, picture.top));
  }
  const std::size_t count = left_out_of(picture.image, picture.image).either;
  if (count > 0) {
    try {
      require_finite(picture.image, path.string());
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format(
          "{}; so are {} pixels in all (quartet compare leaves them out)", error.what(), count));
    }
  }
}

}  // namespace

RenderSettings reference_settings(const Scene& scene, RenderSettings run) {
  run.seed = reference_seed;
  run.sampler = sampler_for(scene, SamplerId::sobol);
  return run;
}

std::array<std::uint64_t, 2> half_seeds(std::uint64_t seed) {
  return {seed, seed ^ 0x9e3779b97f4a7c15u};
}

double Reference::noise_floor(MetricId id) const {
  return NoiseFloors(*this).of(metric(id));
}

std::optional<Reference> load_own_reference(const std::filesystem::path& path,
                                            const std::stop_token& stop) {
  if (!begins_as_exr(path)) {
    return std::nullopt;
  }
  const std::vector<ExrPartHeader> headers = read_exr_headers(path);
  if (headers.empty() || !holds_sums(headers.front().attributes)) {
    return std::nullopt;
  }
  const std::optional<ReferenceSums> sums = sums_of(read_exr(path, stop), path);
  if (!sums) {
    return std::nullopt;  // another file by now
  }
  Reference reference = reference_of(*sums);
  reference.path = path;
  return reference;
}

std::shared_ptr<const Reference> load_reference(const std::filesystem::path& path,
                                                const PictureOptions& options,
                                                const std::stop_token& stop) {
  if (options.layer.empty()) {
    if (std::optional<Reference> own = load_own_reference(path, stop)) {
      return std::make_shared<const Reference>(std::move(*own));
    }
  }
  Picture picture = read_picture(path, options, stop);
  require_whole(picture, path);
  Reference reference;
  reference.path = path;
  reference.layer = std::move(picture.layer);
  reference.notes = std::move(picture.notes);
  reference.image = std::move(picture.image);
  reference.settings.width = reference.image.width();
  reference.settings.height = reference.image.height();
  return std::make_shared<const Reference>(std::move(reference));
}

void check_reference(const Reference& reference, const Scene& scene,
                     const RenderSettings& settings) {
  if (const std::string reason = mismatch(reference, scene, settings); !reason.empty()) {
    throw std::runtime_error(fmt::format("the reference{}{} does not fit: {}",
                                         reference.path.empty() ? "" : " ", reference.path.string(),
                                         reason));
  }
}

}  // namespace quartet
