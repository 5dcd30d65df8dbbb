#include "renderer/adaptive/lab.h"

#include <algorithm>
#include <chrono>

#include "renderer/parallel.h"
#include "renderer/scene/synthetic.h"

namespace quartet {

Lab::Lab(SampleSource source, int width, int height, std::span<const SamplingPolicy> policies,
         const LabOptions& options)
    : source_(std::move(source)),
      options_(options),
      store_(width, height, options.memory, !options.statistics.variance),
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
  const std::uint32_t behind = frame();
  bool finished = false;
  arena_.execute([&] {
    finished = trace(behind, stop);
    if (!finished) {
      return;
    }
    advance(behind);
    forget();
  });
  return finished;
}

/// Advances the lanes at a frame, whose samples the store holds.
void Lab::advance(std::uint32_t frame) {
  std::vector<Lane*> moving;
  for (Lane& lane : lanes_) {
    if (lane.frame() == frame) {
      lane.begin_frame(store_);
      moving.push_back(&lane);
    }
  }
  // Together, because lanes want much the same samples: what one has brought into the cache, the
  // others find there. The share that each is charged is therefore a little less than what it would
  // take alone, of a time that is small beside that of tracing.
  const auto start = std::chrono::steady_clock::now();
  parallel_for(std::size_t(store_.tile_rows()), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      for (Lane* lane : moving) {
        lane->take(store_, int(row));
      }
    }
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  // One after the other, each on all threads: a lane's own time is then what it would be alone.
  for (Lane* lane : moving) {
    lane->end_frame(took.count() / double(moving.size()));
  }
}

/// Traces what the store lacks for the lanes at a frame.
bool Lab::trace(std::uint32_t frame, std::stop_token stop) {
  const auto lacking = [&](const Lane& lane) {
    return lane.frame() == frame && !store_.holds(lane.taken(), lane.plan().wanted);
  };
  if (std::none_of(lanes_.begin(), lanes_.end(), lacking)) {
    return true;
  }
  const std::size_t pixels = std::size_t(width()) * std::size_t(height());
  begin_.assign(pixels, UINT32_MAX);
  end_.assign(pixels, 0);
  for (const Lane& lane : lanes_) {
    if (lane.frame() != frame) {
      continue;
    }
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::uint32_t taken = lane.taken()[i];
      const std::uint32_t wanted = lane.plan().wanted[i];
      begin_[i] = std::min(begin_[i], wanted > 0 ? taken : UINT32_MAX);
      end_[i] = std::max(end_[i], wanted > 0 ? taken + wanted : 0);
    }
  }
  return store_.require(begin_, end_, source_, store_.traced() == 0 ? std::stop_token() : stop);
}

/// Lets the store give up what costs least to do without, where memory is short: first the means,
/// without which a replay is slower, then what every lane has used, which a replay must trace
/// again.
void Lab::forget() {
  if (store_.bytes() <= options_.memory) {
    return;
  }
  if (store_.has_means()) {
    for (Lane& lane : lanes_) {
      lane.catch_up(store_);
    }
    store_.forget_means();
    if (store_.bytes() <= options_.memory) {
      return;
    }
  }
  std::vector<std::uint32_t> used(lanes_.front().taken().begin(), lanes_.front().taken().end());
  for (const Lane& lane : lanes_) {
    std::transform(used.begin(), used.end(), lane.taken().begin(), used.begin(),
                   [](std::uint32_t a, std::uint32_t b) { return std::min(a, b); });
  }
  store_.trim(used);
}

void Lab::set_policy(std::size_t lane, const SamplingPolicy& policy) {
  arena_.execute([&] { lanes_[lane].restart(policy); });
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
  if (const Synthetic* row = synthetic_of(scene->scene())) {
    return [row, seed = settings.seed](int x, int y, std::uint32_t first,
                                       std::span<glm::vec3> radiance) {
      draw_synthetic(*row, seed, x, y, first, radiance);
    };
  }
  const CameraRays camera(settings.camera, settings.width, settings.height);
  const auto trace = integrator(settings.integrator).trace;
  return [scene = std::move(scene), settings, camera, trace](int x, int y, std::uint32_t first,
                                                             std::span<glm::vec3> radiance) {
    trace(*scene, settings, camera, x, y, first, radiance);
  };
}

}  // namespace quartet
