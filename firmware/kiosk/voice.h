// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Voice: the kiosk's speaker. It plays the sounds that tell everybody what has happened, hands on what the
// pages say while somebody wants to hear it, and is silent at once when nobody does. Thread: main, which it
// never holds up. Errors: none; without a speaker it is silent.
#pragma once

#include <memory>

#include "hal/speaker.h"
#include "ui/speech/narrator.h"
#include "ui/ui.h"

namespace relievo::firmware {

class Voice {
 public:
  explicit Voice(std::unique_ptr<hal::Speaker> speaker) : speaker_(std::move(speaker)) {}

  // What there is to hear with.
  void look(ui::ViewState& view);
  // After a frame was made. True: something is being said to the visitor, who is there as long.
  bool turn(ui::Ui& ui, const ui::ViewState& view);

 private:
  void sound(const ui::Ui& ui, const ui::ViewState& view);

  std::unique_ptr<hal::Speaker> speaker_;
  ui::Cues cues_;
  hal::Instant guided_{};
  bool heard_ = false;
};

}  // namespace relievo::firmware
