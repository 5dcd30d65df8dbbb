#pragma once

#include <chrono>

#include "renderer/session/mailbox.h"
#include "renderer/session/sample_meter.h"

namespace quartet {

class Lab;

/// What a session says of itself: its thread fills `status` in and puts it into the mailbox.
class StatusBoard {
 public:
  using Clock = SampleMeter::Clock;

  explicit StatusBoard(Mailbox& mailbox) : mailbox_(mailbox) {}

  SessionStatus status;
  SampleMeter meter;  ///< of traced samples

  bool idle() const { return status.activity == SessionStatus::Activity::idle; }
  /// Where the lanes stand, and what is stored.
  void describe(const Lab& lab);

  void publish();
  /// Whether the published one has become old news.
  bool is_due() const;

 private:
  Mailbox& mailbox_;
  Clock::time_point published_at_;
};

}  // namespace quartet
