// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/voice.h"

#include <utility>

namespace relievo::firmware {

void Voice::look(ui::ViewState& view) {
  if (speaker_ == nullptr) return;
  for (std::size_t i = 0; i < ui::kLanguages; ++i)
    view.voices[i] = speaker_->has_voice(ui::info_of(static_cast<ui::Language>(i)).code);
  view.headphones = speaker_->has_headphones();
}

bool Voice::turn(ui::Ui& ui, const ui::ViewState& view) {
  if (speaker_ == nullptr) return false;
  const bool heard = ui.is_heard(view);
  if (std::exchange(heard_, heard) && !heard) speaker_->hush();
  const bool speaks = speaker_->is_speaking();
  const ui::Utterance& said = ui.speak(view, speaks);
  if (said.empty()) return speaks;
  const ui::Visit& visit = ui.visit();
  speaker_->say(
      {said.text(), said.language, ui::kVolumePercents[visit.volume], ui::kSpeedPercents[visit.speed]});
  return true;
}

}  // namespace relievo::firmware
