#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/files/exr.h"
#include "renderer/measure/reference/reference.h"

namespace quartet {

/// What a reference is made of, and what its file holds: for each pixel the sums of two halves of
/// its samples.
struct ReferenceSums {
  struct Half {
    std::vector<glm::dvec3> sums;         ///< of samples (linear radiance), without rejected ones
    std::vector<std::uint32_t> rejected;  ///< negative or not finite
    bool operator==(const Half&) const = default;
  };

  std::string scene_name;
  std::string scene_hash;
  RenderSettings settings;
  std::uint64_t spp = 0;  ///< of both halves together
  double seconds = 0.0;   ///< wall-clock, that they took
  std::array<Half, 2> halves;

  /// Samples of each pixel in a half, the rejected ones included.
  std::uint64_t samples_of(std::size_t half) const { return (spp + 1 - half) / 2; }
};

/// The pictures that the sums make.
Reference reference_of(const ReferenceSums& sums);

/// R, G, B, SampleCount and Rejected as in other files of ours, and Half0 and Half1: the doubles of
/// the sums as two integers each (high and low word), so that they come back to the bit, and their
/// exact counts as integers.
ExrImage exr_of(const ReferenceSums& sums, const std::string& command_line);

/// Whether such a header is of a file that exr_of() made.
bool holds_sums(const std::map<std::string, std::string>& attributes);

/// What exr_of() wrote, or did when SampleCount and Rejected were integers; nothing if the picture,
/// read from `path`, is not one of those. Throws std::runtime_error if it is, but damaged: also if
/// header and pixels contradict each other.
std::optional<ReferenceSums> sums_of(const ExrImage& exr, const std::filesystem::path& path);

/// Samples a pixel in the reference that a file holds, if they are of the same scene, settings and
/// random numbers as `like`: then those of the one with fewer are among those of the other. 0 if
/// there is no such file, or if it is damaged.
std::uint64_t samples_in(const std::filesystem::path& path, const ReferenceSums& like);

}  // namespace quartet
