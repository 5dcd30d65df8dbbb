#pragma once

#include <stdexcept>
#include <stop_token>

namespace quartet {

/// Work that was asked to end before it was done: no error, and nothing to tell.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Throws Cancelled once a stop is asked for. Readers of files call it often enough that closing a
/// window waits for none of them: every few milliseconds of work.
inline void check_cancelled(const std::stop_token& stop) {
  if (stop.stop_requested()) {
    throw Cancelled();
  }
}

/// The same for loops whose rounds take nanoseconds: it looks once in some thousand calls.
class CancelTick {
 public:
  explicit CancelTick(const std::stop_token& stop) : stop_(stop) {}

  void operator()() {
    if ((++calls_ & 0xfffu) == 0) {
      check_cancelled(stop_);
    }
  }

 private:
  std::stop_token stop_;
  unsigned calls_ = 0;
};

}  // namespace quartet
