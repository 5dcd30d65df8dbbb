#include "app/interrupt.h"

#include <cassert>
#include <csignal>
#include <optional>

namespace quartet {
namespace {

// A signal handler can reach nothing but a global.
std::optional<std::stop_source> current;

extern "C" void request_stop(int) {
  // Nobody registers callbacks, so this is one compare-and-swap and safe in a handler.
  current->request_stop();
}

void set_handler(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  // The default handler comes back by itself, for the second Ctrl-C.
  action.sa_flags = SA_RESTART | (handler == SIG_DFL ? 0 : int(SA_RESETHAND));
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  assert(!current);
  current.emplace();
  set_handler(request_stop);
}

Interrupt::~Interrupt() {
  set_handler(SIG_DFL);
  current.reset();
}

std::stop_token Interrupt::token() const {
  return current->get_token();
}

}  // namespace quartet
