#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>

namespace quartet {

/// Counts samples as they are traced and tells how many there are a second.
class SampleMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// From any thread.
  void add(std::uint64_t samples) {
    shards_[shard()].count.fetch_add(samples, std::memory_order_relaxed);
  }

  // The rest from one thread.

  /// Forgets what was before: what follows is not averaged with time in which nothing was asked
  /// for.
  void restart(Clock::time_point now) { marks_.assign(1, {now, total()}); }

  /// Over the last second, or since the restart.
  double per_second(Clock::time_point now) {
    const std::uint64_t count = total();
    while (marks_.size() > 1 && now - marks_[1].time > std::chrono::seconds(1)) {
      marks_.pop_front();
    }
    if (marks_.empty() || now <= marks_.front().time) {
      return 0.0;
    }
    const double seconds = std::chrono::duration<double>(now - marks_.front().time).count();
    const double rate = double(count - marks_.front().count) / seconds;
    if (now - marks_.back().time > std::chrono::milliseconds(100)) {
      marks_.push_back({now, count});
    }
    return rate;
  }

 private:
  // One counter that all threads write would be what they wait for.
  static constexpr std::size_t shard_count = 32;
  struct alignas(64) Shard {
    std::atomic<std::uint64_t> count = 0;
  };
  struct Mark {
    Clock::time_point time;
    std::uint64_t count;
  };

  static std::size_t shard() {
    static std::atomic<std::size_t> threads = 0;
    thread_local const std::size_t mine = threads++ % shard_count;
    return mine;
  }

  std::uint64_t total() const {
    std::uint64_t sum = 0;
    for (const Shard& each : shards_) {
      sum += each.count.load(std::memory_order_relaxed);
    }
    return sum;
  }

  std::array<Shard, shard_count> shards_;
  std::deque<Mark> marks_;
};

}  // namespace quartet
