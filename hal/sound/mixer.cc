// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sound/mixer.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo::hal {
namespace {

struct Tone {
  float hz = 0, ms = 0;  // 0 ms: there is none
};
using Tones = std::array<Tone, 2>;  // one after the other
constexpr std::array<Tones, kSounds> kTones{{
    {{{880, 35}}},                // Tick
    {{{1760, 20}, {1175, 60}}},   // Shutter
    {{{1047, 90}}},               // Taken
    {{{784, 110}, {1047, 190}}},  // Done: upwards
    {{{392, 140}, {294, 220}}},   // Refused: downwards
    {{{440, 60}}},                // Guide
}};
constexpr float kLoudness = 0.12F * 32767;  // quiet: a sign, no alarm
constexpr float kRampMs = 6;                // a tone that begins or ends at once cracks

std::size_t samples_of(float ms) { return std::size_t(ms * kSamplesPerSecond / 1000); }

}  // namespace

Mixer::Number Mixer::begin() {
  wanted_.store((wanted_.load() | 1U) + 1);
  return wanted_.load();
}

void Mixer::cut() { wanted_.store(wanted_.load() | 1U); }

void Mixer::play(Sound sound, float pitch) {
  const auto number = std::uint32_t(asked_.load() >> 40U) + 1;
  const auto hundredths = std::uint64_t(std::clamp(pitch, 0.1F, 10.0F) * 100);
  asked_.store(std::uint64_t{number} << 40U | hundredths << 8U | std::uint64_t(sound));
}

bool Mixer::add(Number text, std::span<const std::int16_t> samples, bool last) {
  const std::size_t put = put_.load();
  if (put - taken_.load() == kPieces) return false;
  Piece& piece = pieces_[put % kPieces];
  piece.text = text;
  piece.last = last;
  piece.size = samples.size();
  std::ranges::copy(samples, piece.samples.begin());
  put_.store(put + 1);
  return true;
}

bool Mixer::put(Number text, std::span<const std::int16_t> samples) {
  return add(text, samples.first(std::min(samples.size(), kPiece)), false);
}

bool Mixer::finish(Number text) { return add(text, {}, true); }

std::int16_t Mixer::next_of_speech() {
  for (;;) {
    const std::size_t taken = taken_.load();
    if (taken == put_.load()) return 0;
    Piece& piece = pieces_[taken % kPieces];
    const bool wanted = is_wanted(piece.text);
    if (wanted && at_ < piece.size) return piece.samples[at_++];
    // Not after the text that has come since: its number is another one.
    if (wanted && piece.last) played_.store(piece.text);
    at_ = 0;
    explicit_bzero(piece.samples.data(), sizeof piece.samples);
    taken_.store(taken + 1);
  }
}

float Mixer::next_of_sound() {
  if (sounding_ == 0) return 0;
  const Tones& tones = kTones[(sounding_ & 0xFFU) % kSounds];
  if (tone_ == tones.size() || tones[tone_].ms == 0) return 0;
  const std::size_t length = samples_of(tones[tone_].ms), ramp = samples_of(kRampMs);
  const std::size_t from_end = std::min(sound_at_, length - sound_at_);
  const float loud = std::min(1.0F, float(from_end) / float(ramp));
  const float value = kLoudness * loud * std::sin(phase_);
  constexpr float kRound = 2 * std::numbers::pi_v<float>;
  phase_ = std::fmod(phase_ + kRound * tones[tone_].hz * pitch_ / kSamplesPerSecond, kRound);
  if (++sound_at_ == length) ++tone_, sound_at_ = 0;
  return value;
}

void Mixer::fill(std::span<std::int16_t> samples) {
  if (const std::uint64_t asked = asked_.load(); asked != sounding_) {
    sounding_ = asked;
    pitch_ = float(asked >> 8U & 0xFFFFU) / 100;
    tone_ = sound_at_ = 0;
    phase_ = 0;
  }
  for (std::int16_t& sample : samples) {
    const float value = float(next_of_speech()) + next_of_sound();
    sample = std::int16_t(std::clamp(value, -32767.0F, 32767.0F));
  }
}

}  // namespace relievo::hal
