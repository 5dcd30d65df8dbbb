#pragma once

#include <span>
#include <string_view>

namespace quartet {

/// What else the samples that decide are used for.
enum class SampleMode {
  /// They are the picture. Cheap, and biased: Kirk and Arvo, "Unbiased Sampling Techniques for
  /// Image Synthesis", SIGGRAPH 1991.
  reuse,
  /// Nothing: a pilot run with random numbers of its own decides, and the picture takes as many
  /// samples of others. Unbiased at twice the samples.
  unbiased,
};

/// One row of the table of sample modes.
struct SampleModeRow {
  SampleMode key;
  std::string_view id;
  std::string_view label;
  std::string_view source;
};

std::span<const SampleModeRow> sample_modes();
const SampleModeRow& sample_mode(SampleMode key);
/// Throws std::invalid_argument that lists the legal ids.
const SampleModeRow& find_sample_mode(std::string_view id);

}  // namespace quartet
