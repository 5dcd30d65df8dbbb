#include "renderer/adaptive/lane.h"

#include <algorithm>
#include <chrono>

namespace quartet {
namespace {

double sample_seconds(const SampleStore& store, std::span<const std::uint32_t> taken) {
  const std::span<const float> cost = store.seconds_per_sample();
  double seconds = 0.0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    seconds += double(taken[i]) * double(cost[i]);
  }
  return seconds;
}

}  // namespace

Lane::Lane(int width, int height, const SamplingPolicy& policy, FilmStatistics statistics)
    : policy_(policy), film_(width, height, statistics), taken_(film_.size(), 0) {
  replan();
}

void Lane::advance(const SampleStore& store) {
  const auto start = std::chrono::steady_clock::now();
  take_samples(store);
  const Estimator& row = estimator(policy_.estimator);
  if (row.estimate) {
    error_.resize(std::size_t(row.channels) * film_.size());
    row.estimate(film_, error_);
  }
  FrameRecord record;
  record.frame = frame() + 1;
  record.samples = (history_.empty() ? 0 : history_.back().samples) + plan_.total;
  history_.push_back(record);
  replan();
  own_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  history_.back().refined = plan_.refined;
  history_.back().max_spp = *std::max_element(taken_.begin(), taken_.end());
  history_.back().seconds = sample_seconds(store, taken_) + own_seconds_;
}

void Lane::take_samples(const SampleStore& store) {
  // Asked for this far ahead, samples have come when they are wanted; else a replay does nothing
  // but wait for memory.
  constexpr std::size_t ahead = 32;
  const std::span<const std::uint32_t> pixels = store.pixels();
  std::vector<glm::vec3> samples;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i + ahead < pixels.size()) {
      const std::uint32_t later = pixels[i + ahead];
      store.prefetch(later, taken_[later], plan_.wanted[later]);
    }
    const std::uint32_t pixel = pixels[i];
    const std::uint32_t wanted = plan_.wanted[pixel];
    if (wanted > 0) {
      samples.resize(wanted);
      store.read(pixel, taken_[pixel], samples);
      film_.add(pixel, samples);
      taken_[pixel] += wanted;
    }
  }
}

void Lane::replan() {
  plan_next(policy_, {film_.width(), film_.height(), error_, taken_, frame()}, plan_);
}

}  // namespace quartet
