// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The letters on the digit keys of a keypad: on the keys where telephones have them (ITU-T E.161, ETSI ES 202
// 130 for Arabic and Hebrew), but on each the frequent ones of names first, which takes a third of the
// presses away (Pavlovych and Stuerzlinger 2003, "Less-Tap"). The digit itself comes last. Thread: any.
// Errors: none.
#pragma once

#include <cstddef>
#include <string_view>

#include "ui/language/language.h"

namespace relievo::ui {

// `times` 0 is the first, round and round. `digit`: '1' to '9'. The text is a constant.
std::string_view keypad_letter(Language language, char digit, std::size_t times, bool capital);

}  // namespace relievo::ui
