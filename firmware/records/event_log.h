// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// EventLog: the last lines of what has happened, for the technician: a ring of fixed size in memory,
// and a file that keeps the newest lines over a restart. Nobody's name goes into it: of an error only
// its sentence is written, never the place, which may be somebody's.
//
// In the file, behind the English text and a tab: the number of the event or of the error's code ("e3",
// "f7"), then the event's values, so that the page can say it in the reader's language. Thread: any. Errors
// of save(): MediaFull, IoFailed.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "hal/clock.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

inline constexpr const char* kLogFile = "relievo.log";  // in the folder of the store

// A line, taken apart. Of one that another version wrote `text` may be all there is.
ui::LogLine entry_of(std::string_view line);

class EventLog {
 public:
  static constexpr std::size_t kLines = 200, kLineBytes = 400, kTextBytes = 200, kFaults = 8;

  // `file` is read where it is there; empty: nothing is kept.
  EventLog(const hal::Clock& clock, std::filesystem::path file);

  void say(ui::LogEvent event, std::initializer_list<std::string_view> values = {});
  void fault(const Error& error);

  std::vector<ui::LogLine> entries() const;  // oldest first
  std::vector<ui::LogLine> faults() const;   // since the start, newest first
  bool unsaved() const;
  Result<void> save();  // on the keeper

 private:
  struct Line {
    std::array<char, kLineBytes> text{};
    std::size_t length = 0;
    bool fault = false;
  };
  void put(std::string text, const std::string& behind, bool fault);
  Line& next_line();
  const Line& line(std::size_t i) const { return ring_[(first_ + i) % kLines]; }  // 0: the oldest

  const hal::Clock& clock_;
  std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::array<Line, kLines> ring_{};
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t said_ = 0, saved_ = 0;
};

}  // namespace relievo::firmware
