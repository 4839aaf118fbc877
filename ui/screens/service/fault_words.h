// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sentence of every error code and of every event of the log, in the reader's language. Thread: any.
// Errors: none.
#pragma once

#include <string_view>

#include "hal/base/result.h"
#include "ui/device/settings.h"
#include "ui/language/language.h"
#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {

const char* words_of(const Words& tr, Errc code);

// `pattern` has a place {} for each value of the event, or for `role` where that is there.
struct LogWords {
  const char* pattern = "";
  const char* role = nullptr;
};
LogWords words_of(const Words& tr, LogEvent event);

// What a setting and its values are called: alike on the settings page and in the log.
const char* name_of(const Words& tr, Setting setting);
// `value` is one of info_of(setting).values.
std::string_view said_value(StaffFrame& page, Setting setting, std::int32_t value);

// A change as the log keeps it; empty where that is no setting, or no value of it (an older version's).
std::string_view said_change(StaffFrame& page, std::string_view key, std::string_view value);

}  // namespace relievo::ui
