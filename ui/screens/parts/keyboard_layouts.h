// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The letters of the keyboard on the screen, as the speakers of a language know them from their own:
// three rows, left to right as they lie on a desk. Thread: any. Errors: none.
#pragma once

#include <array>
#include <span>

#include "ui/language/language.h"

namespace relievo::ui {

using KeyRow = std::span<const char* const>;
using KeyRows = std::array<KeyRow, 3>;

// Chinese and Japanese have the Latin letters: names are typed as in a passport.
KeyRows key_rows(Language language, bool capitals);
// The letters with accents, of all languages with Latin letters.
KeyRows accent_rows(bool capitals);
// Does the language write in large and small letters?
bool has_capitals(Language language);

}  // namespace relievo::ui
