// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mixer: speech that is made piece by piece, and a sound beside it, become what the sound card plays. Three
// threads meet here without a lock, in memory that was there from the start:
//
//   wanted by main: begin(), cut(), play()   made by the voice: put(), finish()   played by the card: fill()
//
// Each piece of speech bears the number of its text: pieces of a text that is not wanted any more are never
// played, however late they come. A piece that was played, or will not be, is wiped: it may spell a visitor's
// name. Samples: mono, 16 bit, kSamplesPerSecond. Errors: none.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "hal/speaker.h"

namespace relievo::hal {

inline constexpr int kSamplesPerSecond = 22050;

class Mixer {
 public:
  using Number = std::uint32_t;  // of a text; grows, and is odd where nothing is wanted

  // A text is wanted from now on, and nothing of those before it.
  Number begin();
  // Nothing is.
  void cut();
  bool is_wanted(Number text) const { return text == wanted_.load(); }
  bool is_speaking() const {
    const Number wanted = wanted_.load();
    return wanted % 2 == 0 && wanted != played_.load();
  }
  void play(Sound sound, float pitch);

  // One piece of speech, in order; false: there is no room yet, and nothing was taken.
  bool put(Number text, std::span<const std::int16_t> samples);
  static constexpr std::size_t kPiece = 512;  // samples at most
  // The text has no more of them. False as above.
  bool finish(Number text);

  void fill(std::span<std::int16_t> samples);

 private:
  struct Piece {
    Number text = 0;
    bool last = false;
    std::size_t size = 0;
    std::array<std::int16_t, kPiece> samples{};
  };
  static constexpr std::size_t kPieces = 16;  // 0.4 s
  bool add(Number text, std::span<const std::int16_t> samples, bool last);
  std::int16_t next_of_speech();
  float next_of_sound();

  std::array<Piece, kPieces> pieces_{};
  std::atomic<std::size_t> put_{0}, taken_{0};  // pieces so far
  std::atomic<Number> wanted_{0}, played_{0};
  std::atomic<std::uint64_t> asked_{0};  // the newest sound: its number, its pitch, which one
  // Of fill() alone.
  std::size_t at_ = 0;  // in the piece that is played
  std::uint64_t sounding_ = 0;
  std::size_t tone_ = 0, sound_at_ = 0;
  float pitch_ = 1, phase_ = 0;
};

}  // namespace relievo::hal
