// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <string>

#include "storage/record.h"

namespace relievo::firmware {

// As the store keeps times.
inline storage::WallTime stored_time(std::chrono::system_clock::time_point time) {
  return std::chrono::floor<std::chrono::milliseconds>(time);
}

// "2026-03-14 09:26 UTC", or as strftime(3) takes it.
inline std::string text_of(storage::WallTime time, const char* format = "%Y-%m-%d %H:%M UTC") {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, format, &parts);
  return text;
}

// A name that every file system of a stick takes, and that sorts by time: 2026-03-12_09-14-07, UTC.
inline std::string stick_name_of(std::chrono::system_clock::time_point time) {
  return text_of(stored_time(time), "%Y-%m-%d_%H-%M-%S");
}

}  // namespace relievo::firmware
