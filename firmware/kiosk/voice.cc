// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/kiosk.h"

#include <utility>

namespace relievo::firmware {
namespace {

constexpr std::chrono::milliseconds kGuide{500};  // between two tones of it

hal::Sound sound_of(ui::Cue cue) {
  switch (cue) {
    case ui::Cue::Shutter: return hal::Sound::Shutter;
    case ui::Cue::Taken: return hal::Sound::Taken;
    case ui::Cue::Done: return hal::Sound::Done;
    case ui::Cue::Refused: return hal::Sound::Refused;
    case ui::Cue::Tick:
    case ui::Cue::None: break;
  }
  return hal::Sound::Tick;
}

}  // namespace

void Voice::look(ui::ViewState& view) {
  if (speaker_ == nullptr) return;
  for (std::size_t i = 0; i < ui::kLanguages; ++i)
    view.voices[i] = speaker_->has_voice(ui::info_of(static_cast<ui::Language>(i)).code);
  view.headphones = speaker_->has_headphones();
}

void Voice::sound(const ui::Ui& ui, const ui::ViewState& view) {
  const ui::Cues now = cues_of(view, ui.visit());
  const ui::Cue cue = ui::cue(std::exchange(cues_, now), now);
  const bool heard = ui.is_heard(view);
  if (cue != ui::Cue::None && (heard || view.settings.is_on(ui::Setting::Sounds)))
    return speaker_->play(sound_of(cue), 1);
  const auto pitch = heard ? guide_pitch(view, ui.visit()) : std::nullopt;
  if (!pitch || view.now - guided_ < kGuide) return;
  guided_ = view.now;
  speaker_->play(hal::Sound::Guide, *pitch);
}

bool Voice::turn(ui::Ui& ui, const ui::ViewState& view) {
  if (speaker_ == nullptr) return false;
  sound(ui, view);
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
