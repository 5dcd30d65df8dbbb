#pragma once

#include <span>
#include <string_view>

namespace quartet {

struct LabState;

/// Keys without a character; those with one are that character, lower case.
enum SpecialKey : int {
  key_escape = 256,
  key_enter,
  key_tab,
  key_left,
  key_right,
  key_up,
  key_down,
  key_page_up,
  key_page_down,
  key_home,
  key_end,
};

struct KeyEvent {
  int key = 0;
  bool down = true;  ///< else released
  bool shift = false;
  bool ctrl = false;
};

/// What a key means that gives this character on the user's keyboard, and that is at this place.
/// `place` is the character that stands there on a US keyboard without Shift, or 0.
///
/// A key means the character that it gives: a German Z is a Z, and a French dot, which needs Shift,
/// a dot. Letters are the same with and without Shift; other characters have it in them. What gives
/// no character that stands on any Latin keyboard (a Russian letter) means what is at its place on
/// a US keyboard, and so does the row of digits where it gives digits only with Shift, as in
/// France.
KeyEvent key_event(char32_t character, int place, bool shift);

/// One row of the table of keys: what the window obeys and what its help shows.
struct KeyRow {
  int key;
  bool shift;
  std::string_view shown;  ///< how the help writes it; empty where the row before says it
  std::string_view what;
  void (*press)(LabState& state);
  void (*release)(LabState& state);  ///< null unless the key acts while it is held
};

std::span<const KeyRow> key_table();

/// What the mouse does, for the same help.
struct MouseRow {
  std::string_view shown, what;
};
std::span<const MouseRow> mouse_table();

/// Acts on a key; returns whether it means anything.
bool handle_key(LabState& state, const KeyEvent& event);

}  // namespace quartet
