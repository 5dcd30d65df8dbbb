#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "renderer/adaptive/session.h"

namespace quartet {

/// What passes between a session's users and its thread: one request, the newest, on the way down;
/// one snapshot and one status, the latest, on the way up. The lock guards nothing but moves of a
/// few pointers. Safe to use from many threads.
class Mailbox {
 public:
  struct Numbered {
    std::uint64_t number;
    LabRequest request;
  };

  /// What a waiting request asks for, against the one submitted before it.
  enum class Waiting { nothing, other_lanes, other_store };

  // For users.
  std::uint64_t submit(LabRequest request);
  std::shared_ptr<const Snapshot> latest() const;
  /// Null before the first one.
  std::shared_ptr<const SessionStatus> status() const;
  bool busy() const {
    return waiting() != Waiting::nothing || working_.load(std::memory_order_relaxed);
  }
  void close();

  // For the session's thread.
  Waiting waiting() const { return waiting_.load(std::memory_order_relaxed); }
  bool closed() const { return closed_.load(std::memory_order_relaxed); }
  /// The waiting request; null if there is none.
  std::unique_ptr<Numbered> take();
  /// Sleeps until there is one; null once closed.
  std::unique_ptr<Numbered> wait_and_take();
  void publish(std::shared_ptr<const Snapshot> snapshot);
  void publish(std::shared_ptr<const SessionStatus> status);
  /// Whether there is work under way: what busy() says beside a request that waits.
  void set_working(bool working) { working_.store(working, std::memory_order_relaxed); }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::unique_ptr<Numbered> request_;
  std::uint64_t submitted_ = 0;
  StoreRequest newest_store_;
  std::shared_ptr<const Snapshot> latest_;
  std::shared_ptr<const SessionStatus> status_;
  std::atomic<Waiting> waiting_ = Waiting::nothing;
  std::atomic<bool> working_ = false;
  std::atomic<bool> closed_ = false;
};

}  // namespace quartet
