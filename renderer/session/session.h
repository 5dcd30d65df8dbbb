#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "renderer/session/lab_request.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// What the renderer is doing.
struct SessionStatus {
  enum class Activity { idle, tracing, replaying };

  Activity activity = Activity::idle;
  std::uint32_t pass = 0;           ///< where the lanes stand, the hindmost of them
  std::uint32_t pass_target = 0;    ///< where they go
  double samples_per_second = 0.0;  ///< traced, over the last second or so; 0 when idle
  std::uint64_t stored_samples = 0;
  std::size_t stored_bytes = 0;
  std::size_t memory_budget = 0;  ///< bytes
  bool partial = false;           ///< the store has forgotten samples: replays trace again
  double replay_seconds = 0.0;    ///< of the last replay, from its request to its last pass
  std::string error;              ///< why the last request failed; empty if all is well
};

class Mailbox;

/// A lab on a thread of its own. Snapshots are what a lab run without a window would give for the
/// same request and pass, to the bit, whatever was asked before.
///
/// submit, latest and status may be called from any thread, never wait for the renderer, and
/// neither allocate nor free under a lock.
///
/// A new store's first pass is always finished and published before the next request is taken, so
/// that each step of a camera drag shows something. A request that keeps the store lets the one
/// under way replay what is stored and publish it; tracing gives way to it unless nothing has been
/// published for as long as that tracing has lasted, so that no drag, however fast, goes without
/// pictures for ever.
class Session {
 public:
  /// `notify` is called on the session's thread after each new snapshot or status, to wake an event
  /// loop; it must not throw.
  explicit Session(std::function<void()> notify = {});
  /// Stops within the time of a few thousand samples.
  ~Session();
  /// Asks it to stop, without waiting.
  void close();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The newest request wins. Returns its number, from 1.
  std::uint64_t submit(LabRequest request);
  /// Null before the first one.
  std::shared_ptr<const Snapshot> latest() const;
  SessionStatus status() const;
  /// Whether it has anything to do. Cheap enough to be asked between two samples.
  bool busy() const;

 private:
  std::unique_ptr<Mailbox> mailbox_;
  std::thread thread_;
};

}  // namespace quartet
