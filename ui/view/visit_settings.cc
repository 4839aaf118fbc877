// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a visit looks and sounds when it begins: as the staff has set it, and silent but for who brings
// headphones.
#include <algorithm>
#include <utility>

#include "ui/view/visit.h"

namespace relievo::ui {

void Visit::look_as_set() {
  language = home_;
  const auto size = std::find(kTextPercents.begin(), kTextPercents.end(), settings_.of(Setting::TextPercent));
  text_size = static_cast<std::size_t>(size - kTextPercents.begin()) % kTextPercents.size();
  high_contrast = settings_.is_on(Setting::Contrast);
  spoken = headphones_;
  volume = kUsualVolume;
  speed = kUsualSpeed;
}

bool Visit::looks_as_set() const {
  return language == home_ && text_percent() == settings_.of(Setting::TextPercent) &&
         high_contrast == settings_.is_on(Setting::Contrast) && spoken == headphones_ &&
         volume == kUsualVolume && speed == kUsualSpeed;
}

// Who plugs headphones in is spoken to; who pulls them out is not, lest others hear it.
void Visit::follow_headphones(const ViewState& view) {
  voices_ = (view.languages & view.voices).any();
  const bool heard = view.headphones && voices_;
  if (std::exchange(headphones_, heard) != heard) {
    spoken = heard;
    touched(view.now);
  }
  spoken = spoken && voices_;
}

void Visit::hear(ActionKind kind) {
  if (kind == ActionKind::Speech) spoken = !spoken && voices_;
  if (kind == ActionKind::Quieter && volume > 0) --volume;
  if (kind == ActionKind::Louder) volume = std::min(volume + 1, kVolumePercents.size() - 1);
  if (kind == ActionKind::Speed) speed = (speed + 1) % kSpeedPercents.size();
}

// What the staff has chosen is seen at once where nobody's visit has begun.
void Visit::follow_settings(const ViewState& view) {
  const bool other = settings_ != view.settings;
  settings_ = view.settings;
  if (other && (step == Step::Attract || step == Step::Starting)) look_as_set();
}

}  // namespace relievo::ui
