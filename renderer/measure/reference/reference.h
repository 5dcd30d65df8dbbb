#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/files/picture.h"
#include "renderer/measure/metrics.h"
#include "renderer/scene/scene_hash.h"
#include "renderer/trace/integrator.h"

namespace quartet {

/// The seed of a reference if no other is asked for. Not 0, that of experiments: a reference made
/// of the samples that it judges would call their noise right.
inline constexpr std::uint64_t reference_seed = 0x5265666572656e63;  // "Referenc"

/// The settings of the reference that is made for a run: its seed is that of references, and its
/// sampler the one with least noise, whatever the run's. All samplers have the same mean, and are
/// best compared with the same truth.
RenderSettings reference_settings(const Scene& scene, RenderSettings run);

/// The seeds of the two halves of a reference.
std::array<std::uint64_t, 2> half_seeds(std::uint64_t seed);

/// The truth that pictures are compared with: a uniform picture of many samples, in two halves that
/// know nothing of each other, or somebody else's picture.
struct Reference {
  std::filesystem::path path;  ///< the file that it is in, may be empty
  RadianceImage image;
  /// The pictures of samples of one seed each; their mean is `image`. Empty for a picture of
  /// another program.
  std::array<RadianceImage, 2> halves;
  std::uint64_t spp = 0;       ///< of both halves together; 0 if not known
  std::uint64_t rejected = 0;  ///< samples that were negative or not finite, of all pixels
  RenderSettings settings;     ///< only width and height for a picture of another program
  std::string scene_name;
  std::string scene_hash;  ///< empty for a picture of another program
  std::string layer;       ///< of the file, that was taken of another program's; may be empty
  std::vector<std::string> notes;  ///< what was done to another program's picture, a line each

  /// Whether it can be said of which scene it is.
  bool ours() const { return !scene_hash.empty(); }

  /// What a metric says of a picture that is right, because the reference is not. For mse, rmse and
  /// relmse_regions it is that of a difference of half of that between the halves, whose variance
  /// is the reference's; for the others that of possible_truths(), which are as far off in the
  /// mean. Of rare bright light that neither half has seen, it knows nothing: then relmse is too
  /// low. Errors below it mean nothing (psnr: above it). NaN if there are no halves.
  double noise_floor(MetricId id) const;
};

/// Reads a reference that ReferenceRender wrote; nothing if the file is another picture. Throws as
/// below.
std::optional<Reference> load_own_reference(const std::filesystem::path& path,
                                            const std::stop_token& stop = {});

/// Reads a reference that ReferenceRender wrote, or any picture that read_picture takes. It is the
/// truth of every pixel: throws std::runtime_error that names the path and what is wrong, also
/// where a pixel is missing or not finite (with their count), and Cancelled soon after a stop was
/// asked for.
std::shared_ptr<const Reference> load_reference(const std::filesystem::path& path,
                                                const PictureOptions& options = {},
                                                const std::stop_token& stop = {});

/// Throws std::runtime_error with the reason if the reference does not show what a run with these
/// settings renders (scene, size, camera, depth), or is made of the same random numbers. Of another
/// program's picture only the size is known. Integrator and sampler may differ: all have the same
/// mean.
void check_reference(const Reference& reference, const Scene& scene,
                     const RenderSettings& settings);

}  // namespace quartet
