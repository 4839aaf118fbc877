// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/records/event_log.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <span>

#include "firmware/base/wall_time.h"
#include "hal/base/whole_file.h"
#include "hal/base/words.h"
#include "ui/screens/service/staff_frame.h"

namespace relievo::firmware {
namespace {

constexpr int kLastCode = int(Errc::Count) - 1;
constexpr std::string_view kGap = "  ", kFault = "  fault: ";

// Up to the next tab, and what is behind it.
std::string_view cut(std::string_view& text) {
  const std::size_t tab = std::min(text.find('\t'), text.size());
  const std::string_view first = text.substr(0, tab);
  text.remove_prefix(std::min(tab + 1, text.size()));
  return first;
}

// The number in "f7"; nothing where another letter stands, or a number above `last`.
std::optional<int> number_behind(std::string_view text, char letter, int last) {
  if (!text.starts_with(letter)) return std::nullopt;
  int number = -1;
  const auto [end, wrong] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  const bool whole = wrong == std::errc() && end == text.data() + text.size();
  return whole && number >= 0 && number <= last ? std::optional(number) : std::nullopt;
}

}  // namespace

ui::LogLine entry_of(std::string_view line) {
  ui::LogLine entry;
  std::string_view rest = line;
  std::string_view text = cut(rest);
  if (const std::size_t gap = text.find(kGap); gap != std::string_view::npos) {
    entry.at = text.substr(0, gap);
    entry.fault = text.substr(gap).starts_with(kFault);
    text.remove_prefix(gap + (entry.fault ? kFault : kGap).size());
  }
  entry.text = text;
  const std::string_view what = cut(rest);
  if (const auto number = number_behind(what, 'f', kLastCode)) entry.code = static_cast<Errc>(*number);
  if (const auto number = number_behind(what, 'e', int(ui::LogEvent::Count) - 1))
    entry.event = static_cast<ui::LogEvent>(*number);
  for (std::string& value : entry.values) value = cut(rest);
  return entry;
}

EventLog::EventLog(const hal::Clock& clock, std::filesystem::path file)
    : clock_(clock), file_(std::move(file)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    Line& next = next_line();
    next.length = line.copy(next.text.data(), kLineBytes);
  }
}

EventLog::Line& EventLog::next_line() {
  if (count_ < kLines) ++count_;
  else first_ = (first_ + 1) % kLines;
  return ring_[(first_ + count_ - 1) % kLines];
}

void EventLog::say(ui::LogEvent event, std::initializer_list<std::string_view> values) {
  const ui::LogWords words = ui::words_of(ui::Words(ui::Language::English), event);
  std::string behind = "\te" + std::to_string(int(event));
  for (const std::string_view value : values) behind.append(1, '\t').append(value);
  put(words.role != nullptr ? filled(words.pattern, {words.role}) : filled(words.pattern, values), behind,
      false);
}

void EventLog::fault(const Error& error) {
  put(std::string(error.what.view()), "\tf" + std::to_string(int(error.code)), true);
}

void EventLog::put(std::string text, const std::string& behind, bool fault) {
  text.insert(0, text_of(stored_time(clock_.wall_now())) + std::string(fault ? kFault : kGap));
  if (text.size() > kTextBytes) text.resize(kTextBytes);
  if (text.size() + behind.size() <= kLineBytes) text += behind;
  const std::lock_guard lock(mutex_);
  Line& next = next_line();
  next.fault = fault;
  next.length = text.copy(next.text.data(), kLineBytes);
  ++said_;
}

std::vector<ui::LogLine> EventLog::entries() const {
  const std::lock_guard lock(mutex_);
  std::vector<ui::LogLine> all;
  for (std::size_t i = 0; i < count_; ++i) all.push_back(entry_of({line(i).text.data(), line(i).length}));
  return all;
}

std::vector<ui::LogLine> EventLog::faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<ui::LogLine> newest;
  for (std::size_t i = count_; i-- > 0 && newest.size() < kFaults;)
    if (line(i).fault) newest.push_back(entry_of({line(i).text.data(), line(i).length}));
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
    for (std::size_t i = 0; i < count_; ++i) text.append(line(i).text.data(), line(i).length).append(1, '\n');
    saved_ = said;  // one that cannot be written is not tried for ever
  }
  if (file_.empty()) return {};
  return write_whole_file(file_, std::as_bytes(std::span(text)), {}, 0600);
}

}  // namespace relievo::firmware
