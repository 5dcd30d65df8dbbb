#pragma once

#include <stdexcept>
#include <stop_token>

namespace quartet {

/// Work that was ended by a signal.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

/// From here on Ctrl-C, SIGTERM and a terminal that goes away leave no unfinished files behind.
/// They end the program as they would otherwise, unless an Interrupt lives.
void handle_signals();

/// While this lives, these signals ask `token()` to stop; a second one ends the program at once.
/// One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const;
};

}  // namespace quartet
