#include "app/window/closing_time.h"

#include <cstdlib>

#include "renderer/files/leftovers.h"

namespace quartet {

ClosingTime::ClosingTime(std::chrono::milliseconds limit)
    : thread_([this, limit] {
        std::unique_lock lock(mutex_);
        if (!changed_.wait_for(lock, limit, [this] { return closed_; })) {
          while (signals_are_held()) {  // files get their names: that is soon done
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
          remove_leftovers();
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
