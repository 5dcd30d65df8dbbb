#pragma once

#include <stdexcept>
#include <stop_token>

namespace quartet {

/// Work that was ended by Ctrl-C or SIGTERM.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

/// While this lives, Ctrl-C and SIGTERM ask `token()` to stop; a second one ends the program at
/// once. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const;
};

}  // namespace quartet
