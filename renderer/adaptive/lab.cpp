#include "renderer/adaptive/lab.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/base/math/hash_mix.h"
#include "renderer/base/parallel.h"
#include "renderer/base/stopwatch.h"
#include "renderer/scene/synthetic.h"

namespace quartet {

Lab::Lab(SampleSource source, int width, int height, std::span<const LaneSettings> lane_settings,
         const LabOptions& options)
    : options_(options),
      // A film with statistics of its own adds samples up, and has no use for means.
      shown_{std::move(source),
             SampleStore(width, height, options.memory, !options.statistics.any())},
      arena_(options.threads > 0 ? options.threads : tbb::task_arena::automatic) {
  check(lane_settings, options_.reference.get());
  for (const LaneSettings& settings : lane_settings) {
    lanes_.emplace_back(width, height, settings, lane_inputs());
  }
  make_pilot();
}

void Lab::check(std::span<const LaneSettings> lane_settings, const RadianceImage* reference) const {
  if (reference && (reference->width() != width() || reference->height() != height())) {
    throw std::invalid_argument(fmt::format("the reference has {}x{} pixels and the picture {}x{}",
                                            reference->width(), reference->height(), width(),
                                            height()));
  }
  for (const LaneSettings& settings : lane_settings) {
    const Estimator& row = estimator(settings.estimator);
    if (row.needs_reference && !reference) {
      throw std::invalid_argument(
          fmt::format("estimator '{}' compares with a reference, and there is none", row.id));
    }
    if (settings.mode == SampleMode::unbiased && !options_.pilot_source) {
      throw std::invalid_argument(
          fmt::format("mode '{}' needs samples for its pilot run, and there is no source of them",
                      sample_mode(settings.mode).id));
    }
  }
}

/// The store of pilot runs, with the first lane that has one; the two share the memory.
void Lab::make_pilot() {
  const bool wanted = std::ranges::any_of(
      lanes_, [](const Lane& lane) { return lane.settings().mode == SampleMode::unbiased; });
  if (wanted && !pilot_) {
    const std::size_t half = options_.memory / 2;
    pilot_.emplace(Stream{options_.pilot_source,
                          SampleStore(width(), height(), half, !options_.statistics.any())});
    shown_.store.set_memory_budget(half);
  }
}

LaneStores Lab::stores() const {
  return {shown_.store, pilot_ ? &pilot_->store : nullptr};
}

bool Lab::takes_from(const Lane& lane, const Stream& stream) const {
  return &stream == &shown_ || lane.settings().mode == SampleMode::unbiased;
}

std::uint32_t Lab::pass() const {
  std::uint32_t behind = lanes_.empty() ? 0 : lanes_.front().pass();
  for (const Lane& lane : lanes_) {
    behind = std::min(behind, lane.pass());
  }
  return behind;
}

std::uint64_t Lab::stored_samples() const {
  return shown_.store.stored() + (pilot_ ? pilot_->store.stored() : 0);
}

std::size_t Lab::stored_bytes() const {
  return shown_.store.bytes() + (pilot_ ? pilot_->store.bytes() : 0);
}

bool Lab::partial() const {
  return shown_.store.partial() || (pilot_ && pilot_->store.partial());
}

std::vector<Lane*> Lab::lanes_at(std::uint32_t pass) {
  std::vector<Lane*> found;
  for (Lane& lane : lanes_) {
    if (lane.pass() == pass) {
      found.push_back(&lane);
    }
  }
  return found;
}

bool Lab::run_pass(std::stop_token stop) {
  return step(lanes_at(pass()), std::move(stop));
}

bool Lab::run_pass_of(std::size_t lane, std::stop_token stop) {
  Lane* const moving = &lanes_[lane];
  return step(std::span(&moving, 1), std::move(stop));
}

/// Takes lanes, all at the same pass, to the next one.
bool Lab::step(std::span<Lane* const> moving, std::stop_token stop) {
  bool finished = false;
  arena_.execute([&] {
    finished = trace(shown_, moving, stop) && (!pilot_ || trace(*pilot_, moving, stop));
    if (!finished) {
      return;
    }
    advance(moving);
    charge(true);
    forget(shown_);
    if (pilot_) {
      forget(*pilot_);
    }
  });
  return finished;
}

/// Advances lanes whose samples the stores hold.
void Lab::advance(std::span<Lane* const> moving) {
  for (Lane* lane : moving) {
    lane->begin_pass(stores());
  }
  // Together, because lanes want much the same samples: what one has brought into the cache, the
  // others find there. The share that each is charged is therefore a little less than what it would
  // take alone, of a time that is small beside that of tracing.
  const Stopwatch watch;
  parallel_for(std::size_t(shown_.store.tile_rows()), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      for (Lane* lane : moving) {
        lane->take(stores(), int(row));
      }
    }
  });
  const double took = watch.seconds();
  // One after the other, each on all threads: a lane's own time is then what it would be alone.
  for (Lane* lane : moving) {
    lane->end_pass(took / double(moving.size()));
  }
}

bool Lab::run_passes(std::uint32_t last, std::stop_token stop) {
  const std::uint32_t behind = pass();
  bool replayed = false;
  if (last > behind + 1) {
    arena_.execute([&] { replayed = replay(behind, last); });
  }
  return replayed || run_pass(std::move(stop));
}

/// Takes the lanes at a pass that can be replayed as far as stored samples go, and a moment allows;
/// false if there are none.
bool Lab::replay(std::uint32_t pass, std::uint32_t last) {
  std::vector<Lane*> moving = lanes_at(pass);
  std::erase_if(moving, [&](const Lane* lane) { return !lane->can_replay(shown_.store); });
  if (moving.empty()) {
    return false;
  }
  // A replay is not interrupted: so many pixels take a tenth of a second or two.
  constexpr std::size_t most_pixels = std::size_t(1) << 25;
  const std::size_t pixels = std::size_t(width()) * std::size_t(height()) * moving.size();
  const auto most = std::uint32_t(std::max<std::size_t>(most_pixels / pixels, 2));
  std::vector<std::unique_ptr<Replay>> replays;
  replays.reserve(moving.size());
  for (Lane* lane : moving) {
    replays.push_back(lane->begin_replay(shown_.store, std::min(last - pass, most)));
  }
  run_replays(replays);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    moving[i]->end_replay(shown_.store, *replays[i]);
  }
  charge(false);
  return true;
}

/// Charges all lanes by what samples are known to take by now: also those of before, and lanes that
/// rest, so that all can be compared and say what a replay of the same stores would say.
/// `one_pass`: no lane has moved further since they were charged last.
void Lab::charge(bool one_pass) {
  SampleCosts costs = shown_.store.costs();
  if (pilot_) {
    costs.add(pilot_->store.costs());
  }
  const bool last_only = one_pass && costs == charged_by_;
  charged_by_ = costs;
  for (Lane& lane : lanes_) {
    lane.charge(costs, last_only);
  }
}

/// Traces what a store lacks for the next pass of some lanes.
bool Lab::trace(Stream& stream, std::span<Lane* const> moving, std::stop_token stop) {
  const auto lacks = [&](const Lane* lane) {
    return takes_from(*lane, stream) && !stream.store.holds(lane->taken(), lane->plan().wanted);
  };
  if (std::ranges::none_of(moving, lacks)) {
    return true;
  }
  return stream.store.require(wishes_of(moving, stream), stream.source,
                              stream.store.traced() == 0 ? std::stop_token() : stop);
}

/// What lanes take from a store next.
std::vector<SampleWish> Lab::wishes_of(std::span<Lane* const> lanes, const Stream& stream) const {
  std::vector<SampleWish> wishes;
  for (const Lane* lane : lanes) {
    if (takes_from(*lane, stream)) {
      wishes.push_back({lane->taken(), lane->plan().wanted});
    }
  }
  return wishes;
}

/// Memory of the samples that a store will trace for the next pass: room for them is made before
/// they come.
std::size_t Lab::coming_bytes(const Stream& stream) {
  constexpr std::size_t sample_bytes = sizeof(glm::vec3) + sizeof(std::uint16_t);
  const std::vector<Lane*> moving = lanes_at(pass());
  std::uint64_t most = 0;
  for (const Lane* lane : moving) {
    most += takes_from(*lane, stream) ? lane->plan().total : 0;
  }
  // Looked at more closely where it may matter.
  return sample_bytes * (stream.store.bytes() + most * sample_bytes > stream.store.memory_budget()
                             ? stream.store.missing(wishes_of(moving, stream))
                             : most);
}

/// Lets a store give up what costs least to do without, where memory is short, before the next
/// pass fills it: first the means, without which a replay is slower, then what no lane takes next,
/// which a replay must trace again.
void Lab::forget(Stream& stream) {
  SampleStore& store = stream.store;
  store.forget_loose();
  const std::size_t coming = coming_bytes(stream);
  const auto fits = [&] { return store.bytes() + coming <= store.memory_budget(); };
  if (fits()) {
    return;
  }
  const bool is_shown = &stream == &shown_;
  if (store.has_means()) {
    for (Lane& lane : lanes_) {
      if (is_shown) {
        lane.catch_up_shown(store);
      } else {
        lane.catch_up_pilot(store);
      }
    }
    store.forget_means();
    if (fits()) {
      return;
    }
  }
  // A pixel that a lane is done with has most likely had its last sample from it.
  const std::size_t pixels = std::size_t(width()) * std::size_t(height());
  std::vector<std::uint32_t> needed(pixels, UINT32_MAX);
  for (const Lane& lane : lanes_) {
    if (takes_from(lane, stream)) {
      for (std::size_t i = 0; i < pixels; ++i) {
        needed[i] = std::min(needed[i], lane.plan().wanted[i] > 0 ? lane.taken()[i] : UINT32_MAX);
      }
    }
  }
  store.trim(needed, coming);
}

void Lab::set_settings(std::size_t lane, const LaneSettings& settings) {
  check(std::span(&settings, 1), options_.reference.get());
  arena_.execute([&] { lanes_[lane].restart(settings, lane_inputs()); });
  make_pilot();
}

void Lab::set_lanes(std::span<const LaneSettings> lane_settings, FilmStatistics statistics,
                    std::shared_ptr<const RadianceImage> reference) {
  check(lane_settings, reference.get());
  const bool other_truth = reference != options_.reference;
  options_.reference = std::move(reference);
  if (statistics != options_.statistics) {
    options_.statistics = statistics;
    lanes_.clear();
  }
  while (lanes_.size() > lane_settings.size()) {
    lanes_.pop_back();
  }
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    if (i == lanes_.size()) {
      lanes_.emplace_back(width(), height(), lane_settings[i], lane_inputs());
    } else if (lanes_[i].settings() != lane_settings[i] ||
               (other_truth && estimator(lane_settings[i].estimator).needs_reference)) {
      set_settings(i, lane_settings[i]);
    }
  }
  make_pilot();
}

void Lab::measure(const std::function<TrueError(const Film&)>& error_of) {
  for (Lane& lane : lanes_) {
    if (lane.pass() > 0 && std::isnan(lane.history().back().truth.error)) {
      lane.set_true_error(error_of(lane.film()));
    }
  }
}

void Lab::forget_true_errors() {
  for (Lane& lane : lanes_) {
    lane.forget_true_errors();
  }
}

void Lab::rewind_past(std::uint32_t pass, std::size_t count) {
  for (std::size_t i = 0; i < std::min(count, lanes_.size()); ++i) {
    if (lanes_[i].pass() > pass) {
      set_settings(i, LaneSettings(lanes_[i].settings()));
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
  check_integrator(scene->scene(), settings.integrator);
  const CameraRays camera(settings.camera, settings.width, settings.height);
  const auto trace = integrator(settings.integrator).trace_jobs;
  return [scene = std::move(scene), settings, camera, trace](std::span<SampleJob> jobs) {
    trace(*scene, settings, camera, jobs);
  };
}

SampleSource pilot_source(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings) {
  RenderSettings other = settings;
  // A bijection, so that no two seeds share their pilot's.
  other.seed = hash_mix(settings.seed + golden_step);
  return sample_source(std::move(scene), other);
}

}  // namespace quartet
