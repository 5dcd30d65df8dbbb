#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace quartet {

/// Tells on stderr how far long work is, once it has taken more than a second: a bar with the time
/// left on a terminal, else a plain line now and then.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` done in [0, 1]; `detail` says where the work is.
  void update(double fraction, std::string_view detail);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool terminal_;
  bool bar_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace quartet
