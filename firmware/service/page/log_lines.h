// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of the log as a page draws them, newest faults on the health page and everything on the log's own.
// Thread: main.
#pragma once

#include <vector>

#include "firmware/records/event_log.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

// Borrows the entries.
void show_lines(const std::vector<LogEntry>& entries, std::vector<ui::LogLine>& lines);

}  // namespace relievo::firmware
