#pragma once

#include <filesystem>

namespace quartet {

/// A file or an empty folder that must not outlive the program, whatever ends it: while this lives
/// remove_leftovers() removes it. Some hundred at a time; more are not remembered.
class Leftover {
 public:
  explicit Leftover(const std::filesystem::path& path);
  ~Leftover();
  Leftover(Leftover&& other) noexcept;
  Leftover& operator=(Leftover&& other) noexcept;

 private:
  void forget() noexcept;

  int slot_ = -1;
};

/// For a handler of a signal that ends the program. Async-signal-safe.
void remove_leftovers() noexcept;

/// While one lives, files change their names and must not be stopped half-way.
class HoldSignals {
 public:
  HoldSignals() noexcept;
  ~HoldSignals();  ///< raises the signal that came meanwhile
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;
};

/// Whether one lives.
bool signals_are_held() noexcept;

/// For a handler: whether the signal has to wait; it comes again when there is nothing to wait for.
/// Async-signal-safe.
bool hold_signal(int signal) noexcept;

}  // namespace quartet
