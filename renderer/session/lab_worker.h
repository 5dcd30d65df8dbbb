#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

#include "renderer/adaptive/lab.h"
#include "renderer/measure/metrics.h"
#include "renderer/session/mailbox.h"
#include "renderer/session/snapshot_pool.h"
#include "renderer/session/status_board.h"

namespace quartet {

/// What a session does on its thread: takes requests out of the mailbox, runs a lab until they are
/// answered, and puts snapshots and statuses back.
class LabWorker {
 public:
  LabWorker(Mailbox& mailbox, std::function<void()> notify);

  /// Returns when the mailbox is closed.
  void run();

 private:
  using Clock = SampleMeter::Clock;
  using Activity = SessionStatus::Activity;

  /// Thrown through the tracer to end a pass of which nothing shall be kept.
  struct Closed {};

  void begin(std::unique_ptr<Mailbox::Numbered> newest);
  std::vector<LaneSettings> lane_settings() const;
  void make_lab();
  void change_lab();
  bool measure_anew();
  bool keep_up_baseline();
  void measure();
  std::unique_ptr<Mailbox::Numbered> answer();
  void fail(const char* reason);

  bool gives_way() const;
  bool tracing_gives_way() const;
  SampleSource watched(SampleSource trace);

  bool lanes_are_together() const;
  bool has_run_out() const;
  bool snapshot_is_due() const;
  bool is_answered_by_shown() const;
  std::span<const Lane> asked_lanes() const;
  void publish_lanes();
  void publish_shown_again();
  void publish(std::unique_ptr<Snapshot> snapshot);
  void publish_status();
  void notify() const;
  void report_progress();

  Mailbox& mailbox_;
  std::function<void()> notify_;
  std::thread::id thread_;
  std::shared_ptr<SnapshotPool> pool_ = std::make_shared<SnapshotPool>();
  StatusBoard board_;

  std::unique_ptr<Mailbox::Numbered> current_;
  std::unique_ptr<Lab> lab_;  // of the current request
  // What true errors in the records of its lanes are of.
  std::shared_ptr<const RadianceImage> measured_against_;
  MetricId measured_in_ = default_metric;
  std::stop_source stop_;  // of the pass under way
  bool owes_first_picture_ = false;

  std::shared_ptr<const Snapshot> shown_;  // the last one published of this lab
  LaneRequest shown_lanes_;                // that it answers
  std::uint64_t published_ = 0;
  Clock::time_point published_at_;

  bool answered_ = true;                // something was published for the current request
  bool complete_ = true;                // and so was all that it asks for
  Clock::time_point unanswered_since_;  // when the first of those without an answer was taken
  Clock::time_point patience_ends_;     // until then tracing does not give way to other lanes

  std::uint32_t replays_to_ = 0;  // the pass at which a replay has caught up
  bool replaying_ = false;
  Clock::time_point replay_start_;
};

}  // namespace quartet
