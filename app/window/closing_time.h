#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace quartet {

/// Ends the program with status 0 after so long, unless what is to be closed is closed by then and
/// this destroyed: gigabytes that are given back page by page, a hierarchy in the middle of its
/// building. All work is asked to stop before, and what must last is written before; files that are
/// only half written go.
class ClosingTime {
 public:
  explicit ClosingTime(std::chrono::milliseconds limit);
  ~ClosingTime();
  ClosingTime(const ClosingTime&) = delete;
  ClosingTime& operator=(const ClosingTime&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace quartet
