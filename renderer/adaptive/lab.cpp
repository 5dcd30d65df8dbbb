#include "renderer/adaptive/lab.h"

#include <algorithm>

#include "renderer/parallel.h"

namespace quartet {

Lab::Lab(SampleSource source, int width, int height, std::span<const SamplingPolicy> policies,
         const LabOptions& options)
    : source_(std::move(source)),
      options_(options),
      store_(width, height, options.memory),
      arena_(options.threads > 0 ? options.threads : tbb::task_arena::automatic) {
  for (const SamplingPolicy& policy : policies) {
    lanes_.emplace_back(width, height, policy, options_.statistics);
  }
}

std::uint32_t Lab::frame() const {
  std::uint32_t behind = lanes_.empty() ? 0 : lanes_.front().frame();
  for (const Lane& lane : lanes_) {
    behind = std::min(behind, lane.frame());
  }
  return behind;
}

bool Lab::run_frame(std::stop_token stop) {
  std::vector<Lane*> moving;
  for (Lane& lane : lanes_) {
    if (lane.frame() == frame()) {
      moving.push_back(&lane);
    }
  }
  const std::size_t pixels = std::size_t(width()) * std::size_t(height());
  std::vector<std::uint32_t> begin(pixels, UINT32_MAX);
  std::vector<std::uint32_t> end(pixels, 0);
  for (const Lane* lane : moving) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::uint32_t taken = lane->taken()[i];
      const std::uint32_t wanted = lane->plan().wanted[i];
      begin[i] = std::min(begin[i], wanted > 0 ? taken : UINT32_MAX);
      end[i] = std::max(end[i], wanted > 0 ? taken + wanted : 0);
    }
  }
  if (store_.traced() == 0) {
    stop = {};
  }
  bool finished = false;
  arena_.execute([&] {
    finished = store_.require(begin, end, source_, stop);
    if (finished) {
      parallel_for(moving.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          moving[i]->advance(store_);
        }
      });
    }
  });
  if (finished) {
    forget();
  }
  return finished;
}

/// Lets the store drop what every lane has used, where memory is short.
void Lab::forget() {
  if (store_.bytes() <= options_.memory) {
    return;
  }
  std::vector<std::uint32_t> used(lanes_.front().taken().begin(), lanes_.front().taken().end());
  for (const Lane& lane : lanes_) {
    std::transform(used.begin(), used.end(), lane.taken().begin(), used.begin(),
                   [](std::uint32_t a, std::uint32_t b) { return std::min(a, b); });
  }
  store_.trim(used);
}

void Lab::set_policy(std::size_t lane, const SamplingPolicy& policy) {
  lanes_[lane] = Lane(width(), height(), policy, options_.statistics);
}

void Lab::set_lanes(std::span<const SamplingPolicy> policies, FilmStatistics statistics) {
  if (statistics != options_.statistics) {
    options_.statistics = statistics;
    lanes_.clear();
  }
  while (lanes_.size() > policies.size()) {
    lanes_.pop_back();
  }
  for (std::size_t i = 0; i < policies.size(); ++i) {
    if (i == lanes_.size()) {
      lanes_.emplace_back(width(), height(), policies[i], statistics);
    } else if (lanes_[i].policy() != policies[i]) {
      set_policy(i, policies[i]);
    }
  }
}

void Lab::rewind_past(std::uint32_t frame) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    if (lanes_[i].frame() > frame) {
      set_policy(i, SamplingPolicy(lanes_[i].policy()));
    }
  }
}

SampleSource sample_source(std::shared_ptr<const TraceScene> scene,
                           const RenderSettings& settings) {
  const CameraRays camera(settings.camera, settings.width, settings.height);
  const auto trace = integrator(settings.integrator).trace;
  return [scene = std::move(scene), settings, camera, trace](int x, int y, std::uint32_t first,
                                                             std::span<glm::vec3> radiance) {
    trace(*scene, settings, camera, x, y, first, radiance);
  };
}

}  // namespace quartet
