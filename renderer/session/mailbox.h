#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "renderer/base/latest.h"
#include "renderer/base/request_slot.h"
#include "renderer/session/session.h"

namespace quartet {

/// What passes between a session's users and its thread: one request, the newest, on the way down;
/// one snapshot and one status, the latest, on the way up. Safe to use from many threads, and what
/// is done under a lock is as little as RequestSlot and Latest say.
class Mailbox {
 public:
  using Numbered = RequestSlot<LabRequest>::Numbered;

  /// What a waiting request asks for, against the one submitted before it.
  enum class Waiting { nothing, other_lanes, other_store };

  // For users.
  std::uint64_t submit(LabRequest request);
  /// Null before the first one.
  std::shared_ptr<const Snapshot> latest() const { return snapshot_.get(); }
  /// Null before the first one.
  std::shared_ptr<const SessionStatus> status() const { return status_.get(); }
  bool busy() const {
    return waiting() != Waiting::nothing || working_.load(std::memory_order_relaxed);
  }
  void close() { requests_.close(); }

  // For the session's thread.
  Waiting waiting() const { return waiting_.load(std::memory_order_relaxed); }
  bool closed() const { return requests_.closed(); }
  /// The waiting request; null if there is none.
  std::unique_ptr<Numbered> take();
  /// Sleeps until there is one; null once closed.
  std::unique_ptr<Numbered> wait_and_take();
  void publish(std::shared_ptr<const Snapshot> snapshot) { snapshot_.publish(std::move(snapshot)); }
  void publish(std::shared_ptr<const SessionStatus> status) { status_.publish(std::move(status)); }
  /// Whether there is work under way: what busy() says beside a request that waits.
  void set_working(bool working) { working_.store(working, std::memory_order_relaxed); }

 private:
  RequestSlot<LabRequest> requests_;
  std::optional<StoreRequest> newest_store_;  // under the lock of the requests
  std::atomic<Waiting> waiting_ = Waiting::nothing;
  std::atomic<bool> working_ = false;
  Latest<Snapshot> snapshot_;
  Latest<SessionStatus> status_;
};

}  // namespace quartet
