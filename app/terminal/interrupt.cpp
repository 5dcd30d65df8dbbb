#include "app/terminal/interrupt.h"

#include <atomic>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <optional>

#include "renderer/files/leftovers.h"

namespace quartet {
namespace {

// A signal handler can reach nothing but globals.
std::optional<std::stop_source> current;
std::atomic<bool> stops_first = false;  // whether the next signal asks `current` to stop

extern "C" void on_ending_signal(int signal) {
  const int error = errno;
  if (stops_first.exchange(false)) {
    // Nobody registers callbacks, so this is one compare-and-swap and safe in a handler.
    current->request_stop();
  } else if (!hold_signal(signal)) {
    remove_leftovers();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  errno = error;
}

}  // namespace

void handle_signals() {
  struct sigaction action {};
  action.sa_handler = on_ending_signal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    sigaddset(&action.sa_mask, signal);
  }
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction old {};
  sigaction(SIGHUP, nullptr, &old);
  if (old.sa_handler != SIG_IGN) {  // as nohup leaves it
    sigaction(SIGHUP, &action, nullptr);
  }
}

Interrupt::Interrupt() {
  assert(!current);
  current.emplace();
  stops_first = true;
  handle_signals();
}

Interrupt::~Interrupt() {
  stops_first = false;
  current.reset();
}

std::stop_token Interrupt::token() const {
  return current->get_token();
}

}  // namespace quartet
