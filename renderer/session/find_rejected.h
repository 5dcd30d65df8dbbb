#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <stop_token>

#include "renderer/session/background_task.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/store/sample_source.h"

namespace quartet {

/// Films count the samples that they reject and do not say which they were; as a sample is a
/// function of its index, they are found by making them again.

/// The first of a pixel's first `count` samples that no film takes (NaN, infinite or negative);
/// nothing if all are good, or once `stop` is requested.
std::optional<std::uint32_t> first_rejected(const SampleSource& source, int x, int y,
                                            std::uint32_t count, const std::stop_token& stop = {});

/// A sample that no film takes.
struct RejectedSample {
  glm::ivec2 pixel{0};
  std::uint32_t index = 0;
  bool operator==(const RejectedSample&) const = default;
};

/// In which pixel a window looks for one.
struct RejectedQuery {
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  glm::ivec2 pixel{0};
  std::uint32_t count = 0;  ///< samples of the pixel, from the first on

  /// Of any number of samples: the first rejected one is the same.
  bool same_pixel(const RejectedQuery& other) const {
    return scene == other.scene && settings == other.settings && pixel == other.pixel;
  }
};

/// Looks beside the window: a pixel may have many samples.
using RejectedTask = BackgroundTask<RejectedQuery, std::optional<RejectedSample>>;
RejectedTask::Work rejected_work();

}  // namespace quartet
