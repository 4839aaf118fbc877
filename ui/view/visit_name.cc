// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a visitor types or shows: their name, in memory of its own that is wiped.
#include <string.h>

#include "ui/view/visit.h"

namespace relievo::ui {

void Visit::type(std::string_view letter) {
  if (step != Step::Name || overlay != Overlay::None || length_ + letter.size() > name_.size()) return;
  if (letter == " " && (length_ == 0 || name_[length_ - 1] == ' ')) return;
  letter.copy(name_.data() + length_, letter.size());
  length_ += letter.size();
  capitals = letter == " " || letter == "-";
  accents = false;
}

void Visit::enter(std::string_view text, hal::Instant now) {
  if (step != Step::Name || overlay != Overlay::None || length_ > 0 || text.size() > name_.size()) return;
  length_ = text.copy(name_.data(), text.size());
  capitals = accents = false;
  touched(now);
}

void Visit::erase_letter() {
  while (length_ > 0) {
    const char last = name_[--length_];
    name_[length_] = 0;
    if ((static_cast<unsigned char>(last) & 0xC0U) != 0x80U) break;  // the first byte of a letter
  }
  if (length_ == 0) capitals = true;
}

void Visit::wipe_name() {
  explicit_bzero(name_.data(), name_.size());
  length_ = 0;
}

}  // namespace relievo::ui
