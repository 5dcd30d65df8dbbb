#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace quartet {

/// Where the random numbers of a pixel's samples come from.
enum class SamplerId { sobol, independent, replicated };

/// Sequences to which the replicated sampler deals samples out in turn: sample i is of sequence
/// i mod sampler_replicates. Few, because each is the less stratified the shorter it is; not two,
/// because two say next to nothing of how far they scatter.
inline constexpr int replicate_bits = 2;
inline constexpr std::uint32_t sampler_replicates = 1u << replicate_bits;

/// One row of the table of samplers. All have the same mean: they differ in their noise, and in
/// what the samples themselves tell of it.
struct SamplerRow {
  SamplerId key;
  std::string_view id;     ///< on the command line and in files
  std::string_view label;  ///< for people
  std::string_view description;
  /// Whether a pixel's samples tell the variance of their mean.
  bool knows_variance;
  std::string_view variance;  ///< what films have for that variance
  /// What a file calls it: the channels' name, before .R, .G and .B.
  std::string_view variance_channel;
};

std::span<const SamplerRow> samplers();
const SamplerRow& sampler_row(SamplerId key);
/// Throws std::invalid_argument that lists the legal ids.
const SamplerRow& find_sampler(std::string_view id);

}  // namespace quartet
