// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a setting and its values are called: alike on the settings page and in the log. Thread: main. Errors:
// none.
#pragma once

#include <string_view>

#include "ui/device/settings.h"
#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {

const char* name_of(const Words& tr, Setting setting);
// `value` is one of info_of(setting).values.
std::string_view said_value(StaffFrame& page, Setting setting, std::int32_t value);

// A change as the log keeps it; empty where that is no setting, or no value of it
// (an older version's).
std::string_view said_change(StaffFrame& page, std::string_view key, std::string_view value);

}  // namespace relievo::ui
