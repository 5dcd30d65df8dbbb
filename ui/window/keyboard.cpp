#include "ui/window/keyboard.h"

#include <utility>

namespace quartet {

void Keyboard::down(int code, int place, bool shift) {
  last_ = Down{code, place, shift};
}

KeyEvent Keyboard::down_as(int code, int key, bool shift) {
  last_.reset();
  held_[code] = key;
  return {key, true, shift, false};
}

std::optional<KeyEvent> Keyboard::gave(char32_t character) {
  const std::optional<Down> last = std::exchange(last_, std::nullopt);
  if (!last) {
    return std::nullopt;
  }
  const KeyEvent event = key_event(character, last->place, last->shift);
  if (event.key == 0) {
    return std::nullopt;
  }
  held_[last->code] = event.key;
  return event;
}

std::optional<KeyEvent> Keyboard::up(int code) {
  const auto held = held_.find(code);
  if (held == held_.end()) {
    return std::nullopt;
  }
  const KeyEvent event{held->second, false, false, false};
  held_.erase(held);
  return event;
}

}  // namespace quartet
