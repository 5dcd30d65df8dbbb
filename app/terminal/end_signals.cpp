#include "app/terminal/end_signals.h"

#include <unistd.h>

#include <utility>

namespace quartet {

BlockedSignals::BlockedSignals() {
  sigemptyset(&blocked_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && (signal == SIGTERM || now.sa_handler != SIG_IGN)) {
      sigaddset(&blocked_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &blocked_, &before_);
}

BlockedSignals::~BlockedSignals() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

SignalWatch::SignalWatch(const BlockedSignals& signals, std::function<void()> ended)
    : set_(signals.set()),
      thread_([this, ended = std::move(ended)]() mutable { run(std::move(ended)); }) {
}

SignalWatch::~SignalWatch() {
  done_ = true;
  // It waits for signals, and this one wakes it: it does not end.
  // NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread)
  pthread_kill(thread_.native_handle(), SIGTERM);
  thread_.join();
}

void SignalWatch::run(std::function<void()> ended) {
  int first = 0;
  if (sigwait(&set_, &first) != 0 || done_) {
    return;
  }
  ended();
  int second = 0;
  if (sigwait(&set_, &second) == 0 && !done_) {
    pthread_sigmask(SIG_UNBLOCK, &set_, nullptr);
    kill(getpid(), second);
  }
}

}  // namespace quartet
