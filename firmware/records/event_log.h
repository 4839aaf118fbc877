// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// EventLog: the last lines of what has happened, for the technician: a ring of fixed size in memory,
// and a file that keeps the newest lines over a restart. Nobody's name goes into it: of an error only
// its sentence is written, never the place, which may be somebody's.
//
// A line is noted as a Sentence, so that the page can say it in the reader's language. In the file, behind
// the English text and a tab: the sentence packed. Thread: any. Errors of save(): MediaFull, IoFailed.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "hal/base/sentence.h"
#include "hal/clock.h"

namespace relievo::firmware {

inline constexpr const char* kLogFile = "relievo.log";  // in the folder of the store

// A line, taken apart. A text that no key is known of (an older file's) has none: then `sentence` is all
// there is.
struct LogEntry {
  std::string at;  // date and time
  bool fault = false;
  std::string sentence;  // English
  std::string key;       // of the catalogues, with {} for each value
  std::vector<std::string> values;
};
LogEntry entry_of(std::string_view line);

class EventLog {
 public:
  static constexpr std::size_t kLines = 200, kLineBytes = 400, kTextBytes = 200, kFaults = 8;

  // `file` is read where it is there; empty: nothing is kept.
  EventLog(const hal::Clock& clock, std::filesystem::path file);

  // Both as a Sentence has them.
  void say(Literal key, std::initializer_list<std::string_view> values = {});
  void fault(const Error& error);

  std::vector<LogEntry> entries() const;  // oldest first
  std::vector<LogEntry> faults() const;   // since the start, newest first
  bool unsaved() const;
  Result<void> save();  // on the keeper

 private:
  struct Line {
    std::array<char, kLineBytes> text{};
    std::size_t length = 0;
    bool fault = false;
  };
  void put(const Sentence& sentence, bool fault);

  const hal::Clock& clock_;
  std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::array<Line, kLines> ring_{};
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t said_ = 0, saved_ = 0;
};

}  // namespace relievo::firmware
