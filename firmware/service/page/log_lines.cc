// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page/log_lines.h"

#include <algorithm>

namespace relievo::firmware {

void show_lines(const std::vector<LogEntry>& entries, std::vector<ui::LogLine>& lines) {
  lines.clear();
  for (const LogEntry& entry : entries) {
    ui::LogLine& line =
        lines.emplace_back(ui::LogLine{entry.at, entry.fault, entry.text, entry.code, entry.event, {}});
    for (std::size_t i = 0; i < std::min(entry.values.size(), line.values.size()); ++i)
      line.values[i] = entry.values[i];
  }
}

}  // namespace relievo::firmware
