#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace quartet {

/// While this lives, Ctrl-C (SIGINT), SIGTERM and SIGHUP end nothing by themselves, but wait to be
/// taken by a SignalWatch. SIGINT and SIGHUP that were to be ignored still are, as under nohup.
/// Made before the first thread, which all have its mask.
class BlockedSignals {
 public:
  BlockedSignals();
  ~BlockedSignals();
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

  const sigset_t& set() const { return blocked_; }

 private:
  sigset_t blocked_;
  sigset_t before_;
};

/// Calls `ended` on a thread of its own at the first of these signals, so that it may do more than
/// a handler can; the second one does what it does without us.
class SignalWatch {
 public:
  SignalWatch(const BlockedSignals& signals, std::function<void()> ended);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  void run(std::function<void()> ended);

  sigset_t set_;
  std::atomic<bool> done_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace quartet
