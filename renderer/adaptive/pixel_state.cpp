#include "renderer/adaptive/pixel_state.h"

#include <algorithm>
#include <array>

#include "renderer/adaptive/lane.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/lane_snapshot.h"
#include "renderer/adaptive/policies/policy.h"

namespace quartet {
namespace {

// In the order of the states.
constexpr std::array<std::string_view, 3> state_labels{"done", "refining", "at the maximum"};

PixelState state_of(bool not_done, std::uint32_t taken, std::uint32_t maximum) {
  if (!not_done) {
    return PixelState::done;
  }
  return taken < maximum ? PixelState::refining : PixelState::at_maximum;
}

/// largest_scaled_error() of the pixels from `first` on.
void scale_errors(const PixelCriterion& criterion, std::size_t first, std::span<float> scaled) {
  const std::size_t pixels = criterion.taken.size();
  float* const out = scaled.data();
  const std::size_t count = scaled.size();
  std::fill_n(out, count, 0.0f);
  for (std::size_t c = 0; c * pixels < criterion.error.size(); ++c) {
    const float threshold = criterion.thresholds[c];
    const float* const error = criterion.error.data() + c * pixels + first;
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
      const float each = scaled_error(error[i], threshold);
      out[i] = each > out[i] ? each : out[i];
    }
  }
}

}  // namespace

std::string_view pixel_state_label(PixelState state) {
  return state_labels[std::size_t(state)];
}

PixelCriterion::PixelCriterion(const LaneSettings& settings, std::span<const float> pixel_errors,
                               std::span<const std::uint32_t> samples)
    : thresholds(settings.thresholds),
      minimum(minimum_samples(settings)),
      maximum(settings.max_spp),
      error(pixel_errors),
      taken(samples) {
}

PixelCriterion::PixelCriterion(const Lane& lane)
    : PixelCriterion(lane.settings(), lane.error(), lane.taken()) {
}

PixelCriterion::PixelCriterion(const LaneSnapshot& lane)
    : PixelCriterion(lane.settings, lane.error, lane.taken) {
}

void mark_not_done(const PixelCriterion& criterion, std::size_t first,
                   std::span<std::uint8_t> marks) {
  const std::size_t pixels = criterion.taken.size();
  std::uint8_t* const row = marks.data();
  const std::size_t count = marks.size();
  std::fill_n(row, count, std::uint8_t(criterion.error.empty()));
  for (std::size_t c = 0; c * pixels < criterion.error.size(); ++c) {
    const float threshold = criterion.thresholds[c];
    const float* const error = criterion.error.data() + c * pixels + first;
#pragma omp simd
    for (std::size_t x = 0; x < count; ++x) {
      row[x] = std::uint8_t(row[x] | std::uint8_t(error[x] > threshold));
    }
  }
  const std::uint32_t minimum = criterion.minimum;
  if (minimum > 0) {
    const std::uint32_t* const taken = criterion.taken.data() + first;
#pragma omp simd
    for (std::size_t x = 0; x < count; ++x) {
      row[x] = std::uint8_t(row[x] | std::uint8_t(taken[x] < minimum));
    }
  }
}

PixelState pixel_state(const PixelCriterion& criterion, std::size_t pixel) {
  std::uint8_t mark = 0;
  mark_not_done(criterion, pixel, {&mark, 1});
  return state_of(mark != 0, criterion.taken[pixel], criterion.maximum);
}

std::vector<PixelState> pixel_states(const PixelCriterion& criterion) {
  std::vector<std::uint8_t> marks(criterion.taken.size());
  mark_not_done(criterion, 0, marks);
  std::vector<PixelState> states(marks.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i] = state_of(marks[i] != 0, criterion.taken[i], criterion.maximum);
  }
  return states;
}

float largest_scaled_error(const PixelCriterion& criterion, std::size_t pixel) {
  float scaled = 0.0f;
  scale_errors(criterion, pixel, {&scaled, 1});
  return scaled;
}

std::vector<float> largest_scaled_errors(const PixelCriterion& criterion) {
  std::vector<float> scaled(criterion.error.empty() ? 0 : criterion.taken.size());
  scale_errors(criterion, 0, scaled);
  return scaled;
}

}  // namespace quartet
