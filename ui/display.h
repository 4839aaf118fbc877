// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Display: a window or a whole screen, with its fingers and keys, and the GL context the Renderer needs.
// Which one it is, firmware/main.cc says. Thread: main.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/base/result.h"

namespace relievo::ui {

// Input: what fingers and a keypad do, as plain data. Pixels of the screen. A mouse is one finger.
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
    Repeat,  // of a keypad: `letter` is 0, which it types where digits are asked for
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

class Display {
 public:
  virtual ~Display() = default;
  virtual int width_px() const = 0;
  virtual int height_px() const = 0;
  virtual std::optional<Input> poll() = 0;
  // A synthetic finger: it comes back through poll(), as a person's does.
  virtual void push(const Input& finger) = 0;
  // A GL context in place of one the driver has lost; what was in that is gone. Errors: LibraryFailed.
  virtual Result<void> renew() = 0;
  virtual void show() = 0;  // what was drawn; waits for the screen where it can
};

struct DisplayOptions {
  int width_px = 0, height_px = 0;  // 0: the whole screen
};

}  // namespace relievo::ui
