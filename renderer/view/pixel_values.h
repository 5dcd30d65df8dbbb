#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "renderer/adaptive/pixel_state.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// Everything about one pixel of a lane.
struct PixelValues {
  glm::vec3 radiance{0.0f};  ///< linear
  std::uint32_t taken = 0;   ///< samples, rejected ones included
  std::uint32_t rejected = 0;
  PixelState state = PixelState::refining;
  int error_channels = 0;             ///< of `error`
  std::array<float, 3> error{};       ///< raw, in the estimator's unit
  float scaled_error = 0.0f;          ///< in units of the threshold, largest channel
  std::optional<glm::vec3> variance;  ///< of the mean, radiance²; where the snapshot has it
};

/// `pixel` counts in rows from the top left.
PixelValues pixel_values(const LaneSnapshot& lane, std::size_t pixel);

}  // namespace quartet
