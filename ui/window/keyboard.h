#pragma once

#include <map>
#include <optional>

#include "ui/window/keys.h"

namespace quartet {

/// Makes key events of what a window system says: a key that went down, the character that it gave
/// after that, a key that came up. A key comes up as what it went down as, whatever Shift and
/// layout have become by then.
class Keyboard {
 public:
  /// A key went down, again if it is held. `place` as in key_event. What gives a character is known
  /// only then.
  void down(int code, int place, bool shift);
  /// A key without a character went down: one of SpecialKey, or the space.
  KeyEvent down_as(int code, int key, bool shift);
  /// The key that went down last gave this character. Nothing if it means nothing here.
  std::optional<KeyEvent> gave(char32_t character);
  /// Nothing if it did not go down, or meant nothing.
  std::optional<KeyEvent> up(int code);

 private:
  struct Down {
    int code = 0;
    int place = 0;
    bool shift = false;
  };

  std::optional<Down> last_;
  std::map<int, int> held_;  // codes, and as which keys they went down
};

}  // namespace quartet
