// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/event_log.h"

#include <algorithm>
#include <fstream>
#include <span>

#include "firmware/command/wall_time.h"
#include "hal/whole_file.h"

namespace relievo::firmware {

EventLog::EventLog(const hal::Clock& clock, std::filesystem::path file) : clock_(clock), file_(std::move(file)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    Line& next = ring_[(first_ + count_) % kLines];
    next.length = std::min(line.size(), kLineBytes);
    line.copy(next.text.data(), next.length);
    if (count_ < kLines) ++count_;
    else first_ = (first_ + 1) % kLines;
  }
}

void EventLog::say(std::string_view what) { put(what, false); }

void EventLog::fault(const Error& error) { put(error.what.view(), true); }

void EventLog::put(std::string_view what, bool fault) {
  const std::string at = text_of(std::chrono::floor<std::chrono::milliseconds>(clock_.wall_now()));
  const std::lock_guard lock(mutex_);
  Line& next = ring_[(first_ + count_) % kLines];
  next.fault = fault;
  next.length = 0;
  for (const std::string_view part : {std::string_view(at), std::string_view(fault ? "  fault: " : "  "), what}) {
    const std::string_view fits = part.substr(0, kLineBytes - next.length);
    fits.copy(next.text.data() + next.length, fits.size());
    next.length += fits.size();
  }
  if (count_ < kLines) ++count_;
  else first_ = (first_ + 1) % kLines;
  ++said_;
}

std::vector<std::string> EventLog::lines() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < count_; ++i) {
    const Line& line = ring_[(first_ + i) % kLines];
    all.emplace_back(line.text.data(), line.length);
  }
  return all;
}

std::vector<std::string> EventLog::faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> newest;
  for (std::size_t i = count_; i-- > 0 && newest.size() < kFaults;) {
    const Line& line = ring_[(first_ + i) % kLines];
    if (line.fault) newest.emplace_back(line.text.data(), line.length);
  }
  return newest;
}

bool EventLog::unsaved() const {
  const std::lock_guard lock(mutex_);
  return said_ != saved_;
}

Result<void> EventLog::save() {
  std::string text;
  std::uint64_t said = 0;
  {
    const std::lock_guard lock(mutex_);
    said = said_;
    for (std::size_t i = 0; i < count_; ++i) {
      const Line& line = ring_[(first_ + i) % kLines];
      text.append(line.text.data(), line.length);
      text += '\n';
    }
    saved_ = said;  // one that cannot be written is not tried for ever
  }
  if (file_.empty()) return {};
  return hal::write_whole_file(file_, std::as_bytes(std::span(text)));
}

}  // namespace relievo::firmware
