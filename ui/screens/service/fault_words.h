// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sentence of every error code and of every event of the log, in the reader's language. Thread: any.
// Errors: none.
#pragma once

#include "hal/base/result.h"
#include "ui/language/language.h"
#include "ui/view/log_event.h"

namespace relievo::ui {

const char* words_of(const Words& tr, Errc code);

// `pattern` has a place {} for each value of the event, or for `role` where that is there.
struct LogWords {
  const char* pattern;
  const char* role = nullptr;
};
LogWords words_of(const Words& tr, LogEvent event);

}  // namespace relievo::ui
