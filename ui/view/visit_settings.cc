// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a visit looks when it begins: as the staff has set it.
#include <algorithm>

#include "ui/view/visit.h"

namespace relievo::ui {

void Visit::look_as_set() {
  language = home_;
  const auto size = std::find(kTextPercents.begin(), kTextPercents.end(), settings_.of(Setting::TextPercent));
  text_size = static_cast<std::size_t>(size - kTextPercents.begin()) % kTextPercents.size();
  high_contrast = settings_.is_on(Setting::Contrast);
}

bool Visit::looks_as_set() const {
  return language == home_ && text_percent() == settings_.of(Setting::TextPercent) &&
         high_contrast == settings_.is_on(Setting::Contrast);
}

// What the staff has chosen is seen at once where nobody's visit has begun.
void Visit::follow_settings(const ViewState& view) {
  const bool other = settings_ != view.settings;
  settings_ = view.settings;
  if (other && (step == Step::Attract || step == Step::Starting)) look_as_set();
}

}  // namespace relievo::ui
