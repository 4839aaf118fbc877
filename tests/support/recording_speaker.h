// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A speaker without a sound card: it writes down what would have been heard, when, and by whom. Its
// headphones are plugged by who holds it. A text takes as many seconds as somebody needs to say it. Thread:
// one.
#pragma once

#include <string>
#include <vector>

#include "hal/clock.h"
#include "hal/speaker.h"

namespace relievo::hal {

class RecordingSpeaker final : public Speaker {
 public:
  struct Heard {
    Instant at;
    std::string text{};      // empty: a sound
    std::string language{};  // of the text
    int volume_percent = 0, speed_percent = 0;
    Sound sound{};
    float pitch = 0;
    bool alone = false;  // in headphones
    bool cut = false;    // what came after it, or hush(), cut it short
  };
  // The languages that have a voice: BCP 47. The clock must outlive it.
  RecordingSpeaker(const Clock& clock, std::vector<std::string> voices)
      : clock_(clock), voices_(std::move(voices)) {}

  void plug(bool in) {
    if (plugged_ && !in) hush();
    plugged_ = in;
  }
  const std::vector<Heard>& heard() const { return heard_; }

  bool has_voice(std::string_view language) const override {
    for (const std::string& voice : voices_) {
      if (voice == language) return true;
    }
    return false;
  }
  bool has_headphones() override { return plugged_; }
  void say(const Speech& speech) override {
    hush();
    if (speech.text.empty()) return;
    heard_.push_back({.at = clock_.now(),
                      .text = std::string(speech.text),
                      .language = std::string(speech.language),
                      .volume_percent = speech.volume_percent,
                      .speed_percent = speech.speed_percent,
                      .alone = plugged_});
    spoken_ = heard_.size();
    until_ = clock_.now() + kPerByte * speech.text.size() * 100 / speech.speed_percent;
  }
  void hush() override {
    if (is_speaking()) heard_[spoken_ - 1].cut = true;
    until_ = {};
  }
  bool is_speaking() const override { return clock_.now() < until_; }
  void play(Sound sound, float pitch) override {
    heard_.push_back({.at = clock_.now(), .sound = sound, .pitch = pitch, .alone = plugged_});
  }

 private:
  static constexpr std::chrono::milliseconds kPerByte{65};
  const Clock& clock_;
  std::vector<std::string> voices_;
  bool plugged_ = false;
  std::vector<Heard> heard_;
  std::size_t spoken_ = 0;  // 1 more than the place of the newest text
  Instant until_{};
};

}  // namespace relievo::hal
