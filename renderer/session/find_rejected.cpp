#include "renderer/session/find_rejected.h"

#include <algorithm>
#include <array>

#include "renderer/adaptive/lab.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {

std::optional<std::uint32_t> first_rejected(const SampleSource& source, int x, int y,
                                            std::uint32_t count, const std::stop_token& stop) {
  std::array<glm::vec3, 16> samples;
  for (std::uint32_t first = 0; first < count && !stop.stop_requested();) {
    const auto size = std::min(count - first, std::uint32_t(samples.size()));
    source(x, y, first, std::span(samples).first(size));
    for (std::uint32_t i = 0; i < size; ++i) {
      if (!acceptable(samples[i])) {
        return first + i;
      }
    }
    first += size;
  }
  return std::nullopt;
}

RejectedTask::Work rejected_work() {
  return [](const RejectedQuery& query, const std::stop_token& stop,
            const RejectedTask::Publish& publish) {
    const auto index = first_rejected(sample_source(query.scene, query.settings), query.pixel.x,
                                      query.pixel.y, query.count, stop);
    if (index) {
      publish(RejectedSample{query.pixel, *index});
    }
  };
}

}  // namespace quartet
