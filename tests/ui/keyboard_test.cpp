// Keys as keyboards of several countries give them.

#include "ui/window/keyboard.h"

#include <gtest/gtest.h>

#include <string_view>

namespace quartet {
namespace {

/// A key at a place, and the character that it gives.
struct Pressed {
  std::string_view keyboard;
  char32_t character;
  int place;
  bool shift;
  int key;  ///< what it means; 0: nothing
};

constexpr Pressed pressed_keys[] = {
    {"US", U'.', '.', false, '.'},
    {"US", U'!', '1', true, '1'},  // with Shift: no row of the table
    {"French", U'.', 0, true, '.'},
    {"French", U',', 'm', false, ','},
    {"French", U'1', '1', true, '1'},
    {"French", U'&', '1', false, '1'},
    {"French", U'é', '2', false, '2'},
    {"French", U'"', '3', false, '3'},
    {"French", U'\'', '4', false, '4'},
    {"French", U'?', 'm', true, '?'},
    {"French", U'q', 'a', false, 'q'},
    {"Czech", U'ě', '2', false, '2'},
    {"German", U'z', 'y', false, 'z'},
    {"German", U'ö', 0, false, 0},
    {"Turkish", U'ç', '.', false, 0},
    {"Turkish", U'ö', ',', false, 0},
    {"Dvorak", U'\'', 'q', false, 0},  // and does not quit
    {"Dvorak", U'b', 'n', false, 'b'},
    {"Russian", U'ю', '.', false, '.'},
    {"Russian", U'б', ',', false, ','},
    {"Russian", U'.', 0, false, '.'},
    {"Russian", U',', 0, true, ','},
    {"Russian", U'д', 'l', false, 'l'},
    {"Greek", U'λ', 'l', false, 'l'},
    {"Arabic", U'٣', '3', false, '3'},
};

TEST(Keyboard, AKeyMeansTheCharacterThatItGives) {
  for (const Pressed& pressed : pressed_keys) {
    SCOPED_TRACE(std::string(pressed.keyboard) + " at " + std::to_string(pressed.place));
    const KeyEvent event = key_event(pressed.character, pressed.place, pressed.shift);
    EXPECT_EQ(event.key, pressed.key);
    EXPECT_TRUE(event.down);
  }
}

TEST(Keyboard, ShiftCountsForLettersAndNotForWhatNeedsIt) {
  EXPECT_TRUE(key_event(U'E', 'e', true).shift);
  EXPECT_FALSE(key_event(U'E', 'e', false).shift) << "Caps Lock is no Shift";
  EXPECT_EQ(key_event(U'E', 'e', true).key, 'e');
  EXPECT_FALSE(key_event(U'.', 0, true).shift);
  EXPECT_FALSE(key_event(U'1', '1', true).shift);
  EXPECT_TRUE(key_event(U'!', '1', true).shift);
}

TEST(Keyboard, AKeyComesUpAsWhatItWentDown) {
  Keyboard keyboard;
  keyboard.down(54, 'c', true);
  const auto down = keyboard.gave(U'C');
  ASSERT_TRUE(down);
  EXPECT_EQ(down->key, 'c');
  EXPECT_TRUE(down->shift);
  const auto up = keyboard.up(54);
  ASSERT_TRUE(up);
  EXPECT_EQ(up->key, 'c');
  EXPECT_FALSE(up->down);
  EXPECT_FALSE(keyboard.up(54)) << "once";
}

TEST(Keyboard, ACharacterIsThatOfTheKeyJustBefore) {
  Keyboard keyboard;
  EXPECT_FALSE(keyboard.gave(U'q')) << "of no key: an input method's";
  EXPECT_EQ(keyboard.down_as(65, ' ', false).key, ' ');
  EXPECT_FALSE(keyboard.gave(U' ')) << "the space has been said";
  EXPECT_EQ(keyboard.up(65)->key, ' ');
  keyboard.down(53, 'x', false);
  EXPECT_TRUE(keyboard.gave(U'x'));
  EXPECT_FALSE(keyboard.gave(U'y'));
  keyboard.down(53, 'x', false);  // held
  EXPECT_TRUE(keyboard.gave(U'x'));
  EXPECT_TRUE(keyboard.up(53));
  keyboard.down(34, 0, false);  // a dead key
  EXPECT_FALSE(keyboard.up(34));
}

}  // namespace
}  // namespace quartet
