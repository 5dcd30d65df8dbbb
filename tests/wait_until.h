#pragma once

#include <chrono>
#include <thread>

namespace quartet::test {

/// Far beyond what anything takes, even under a sanitizer on a busy machine: a deadlock fails.
inline constexpr auto patience = std::chrono::seconds(120);

/// Whether the condition comes true before patience ends. It is looked at every millisecond.
template <class Condition>
[[nodiscard]] bool wait_until(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace quartet::test
