#include "renderer/session/status_board.h"

#include "renderer/adaptive/lab.h"

namespace quartet {

void StatusBoard::describe(const Lab& lab) {
  status.pass = lab.pass();
  status.stored_samples = lab.stored_samples();
  status.stored_bytes = lab.stored_bytes();
  status.partial = lab.partial();
}

void StatusBoard::publish() {
  const Clock::time_point now = Clock::now();
  status.samples_per_second = idle() ? 0.0 : meter.per_second(now);
  published_at_ = now;
  mailbox_.publish(std::make_shared<const SessionStatus>(status));
}

bool StatusBoard::is_due() const {
  constexpr auto interval = std::chrono::milliseconds(100);
  return Clock::now() - published_at_ >= interval;
}

}  // namespace quartet
