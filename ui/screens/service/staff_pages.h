// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pages of the staff, one function each (ui/screens/staff_screens.h has their table).
// Thread: main. Errors: none.
#pragma once

#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {

void pin_page(StaffFrame& page);
void first_start_page(StaffFrame& page);
void records_page(StaffFrame& page);
void statistics_page(StaffFrame& page);
void self_test_page(StaffFrame& page);
void trigger_page(StaffFrame& page);
void log_page(StaffFrame& page);
void health_page(StaffFrame& page);
void settings_page(StaffFrame& page);
void recovery_page(StaffFrame& page);
// Which consent text is in force, how another comes from a stick, how the last try ended; then the button
// that asks for it. Also a step of the first start.
void consent_in_force(StaffFrame& page);
void clock_page(StaffFrame& page);
void touch_page(StaffFrame& page);
void pins_page(StaffFrame& page);

}  // namespace relievo::ui
