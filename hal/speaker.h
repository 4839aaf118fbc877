// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Speaker: what is heard. It says one text at a time, the newest, and plays short sounds beside it.
// What is said is stopped at once by the next text, by hush(), and by the headphones' plug being pulled.
// Thread: one, which no call here holds up: texts are spoken and sounds are mixed on threads of its own.
// Errors: none once it is there: what cannot be played is not heard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace relievo::hal {

enum class Sound : std::uint8_t {
  Tick,     // of a countdown
  Shutter,  // a picture was taken
  Taken,    // a view was taken in calibration
  Done,
  Refused,
  Guide,  // of a given pitch: higher, nearer
};
inline constexpr std::size_t kSounds = 6;

struct Speech {
  std::string_view text;      // UTF-8, borrowed for the call
  std::string_view language;  // BCP 47
  int volume_percent = 100;   // of the loudest there is
  int speed_percent = 100;    // of the voice's usual
};

class Speaker {
 public:
  virtual ~Speaker() = default;
  virtual bool has_voice(std::string_view language) const = 0;
  // Plugged: it is heard by one person alone. What is being said when they are pulled is not said on.
  virtual bool has_headphones() = 0;
  // No text says nothing, as hush() does.
  virtual void say(const Speech& speech) = 0;
  virtual void hush() = 0;
  virtual bool is_speaking() const = 0;
  // `pitch` multiplies the sound's frequencies. A sound replaces the one before it.
  virtual void play(Sound sound, float pitch) = 0;
};

}  // namespace relievo::hal
