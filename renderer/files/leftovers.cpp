#include "renderer/files/leftovers.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <string>
#include <utility>

namespace quartet {
namespace {

enum class SlotState { free, changing, used };

// Of fixed size and never freed: a handler may look at any time and from any thread.
struct LeftoverSlot {
  std::atomic<SlotState> state = SlotState::free;
  std::array<char, PATH_MAX> path{};
};

std::array<LeftoverSlot, 256> leftover_slots;
std::atomic<int> holds = 0;
std::atomic<int> held_signal = 0;

static_assert(std::atomic<SlotState>::is_always_lock_free);

}  // namespace

Leftover::Leftover(const std::filesystem::path& path) {
  const std::string absolute = std::filesystem::absolute(path).string();
  if (absolute.size() >= PATH_MAX) {
    return;
  }
  for (std::size_t i = 0; i < leftover_slots.size(); ++i) {
    LeftoverSlot& slot = leftover_slots[i];
    SlotState expected = SlotState::free;
    if (slot.state.compare_exchange_strong(expected, SlotState::changing)) {
      slot.path[absolute.copy(slot.path.data(), absolute.size())] = '\0';
      slot.state = SlotState::used;
      slot_ = int(i);
      return;
    }
  }
}

Leftover::~Leftover() {
  forget();
}

Leftover::Leftover(Leftover&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {
}

Leftover& Leftover::operator=(Leftover&& other) noexcept {
  if (this != &other) {
    forget();
    slot_ = std::exchange(other.slot_, -1);
  }
  return *this;
}

void Leftover::forget() noexcept {
  if (slot_ >= 0) {
    leftover_slots[std::size_t(slot_)].state = SlotState::free;
    slot_ = -1;
  }
}

void remove_leftovers() noexcept {
  // Files go before the folders that they are in, and folders before those around them.
  constexpr int depth = 8;
  for (int pass = 0; pass < depth; ++pass) {
    for (const LeftoverSlot& slot : leftover_slots) {
      if (slot.state == SlotState::used && ::unlink(slot.path.data()) != 0) {
        ::rmdir(slot.path.data());
      }
    }
  }
}

HoldSignals::HoldSignals() noexcept {
  ++holds;
}

HoldSignals::~HoldSignals() {
  if (--holds == 0) {
    if (const int signal = held_signal.exchange(0); signal != 0) {
      std::raise(signal);
    }
  }
}

bool signals_are_held() noexcept {
  return holds != 0;
}

bool hold_signal(int signal) noexcept {
  if (holds == 0) {
    return false;
  }
  held_signal = signal;
  return true;
}

}  // namespace quartet
