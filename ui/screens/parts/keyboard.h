// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keyboard on the screen, as visitors and staff type on it. Thread: main. Errors: none.
#pragma once

#include "ui/screens/parts/page.h"

namespace relievo::ui {

// `done` is what the key that ends typing does; the visitor's does nothing before there is a name. `letters`:
// whose; most pages have those of the reader.
void keyboard(Page& page, Action done = {ActionKind::Done, 0});
void keyboard(Page& page, Action done, Language letters);

// Digits, and a tick for `done`.
struct PadIds {
  std::string_view digit, done;  // of the keys: the first goes before the digit
};
void number_pad(Page& page, const PadIds& ids, Action done);

}  // namespace relievo::ui
