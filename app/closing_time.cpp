#include "app/closing_time.h"

#include <cstdlib>

namespace quartet {

ClosingTime::ClosingTime(std::chrono::milliseconds limit)
    : thread_([this, limit] {
        std::unique_lock lock(mutex_);
        if (!changed_.wait_for(lock, limit, [this] { return closed_; })) {
          std::_Exit(0);
        }
      }) {
}

ClosingTime::~ClosingTime() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

}  // namespace quartet
