// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input: what fingers and a keypad do, as plain data. Pixels of the screen. A mouse is one finger.
#pragma once

#include <array>
#include <cstdint>

namespace relievo::ui {

inline constexpr std::int64_t kMouse = -1;  // as a finger

struct Input {
  enum class Kind : std::uint8_t {
    Down,
    Move,
    Up,  // a finger
    Next,
    Previous,  // the keypad: focus goes on, or back
    Left,
    Right,
    Above,
    Below,   // focus goes where the eye sees it
    Letter,  // of a keyboard: `letter`
    Digit,   // of a keypad: `letter`; where letters are asked for it types one of those on its key
    Erase,
    Activate,
    Back,  // what has the focus is done; one step back
    Speech,
    Repeat,
    Quieter,
    Louder,
    Speed,  // what is heard: on or off, the page once more, its volume and speed
    Quit    // the window is closed
  };
  Kind kind = Kind::Down;
  std::int64_t finger = 0;
  float x = 0, y = 0;
  std::array<char, 8> letter{};  // UTF-8, a zero behind it
};

}  // namespace relievo::ui
