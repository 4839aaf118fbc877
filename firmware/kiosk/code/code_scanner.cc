// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/code/code_scanner.h"

#include <chrono>
#include <thread>

#include "firmware/base/budget.h"
#include "firmware/kiosk/code/qr_code.h"
#include "firmware/records/receipt.h"
#include "hal/base/utf8.h"

namespace relievo::firmware {
namespace {

// Control, direction, invisible, private, no letter at all.
bool is_unseen(char32_t c) {
  return is_control(c) || c == 0xAD || (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
         (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF || (c >= 0xE000 && c <= 0xF8FF) ||
         (c >= 0xFFF0 && c <= 0xFFFF) || (c & 0xFFFEU) == 0xFFFEU || c >= 0xE0000;
}

constexpr std::chrono::seconds kRest{1};  // after a look that ended by itself

bool wanted(const ui::Visit& visit, const Appliance& appliance) {
  return visit.step == ui::Step::Name && visit.overlay == ui::Overlay::None && visit.name().empty() &&
         appliance.state() == State::Idle;
}

}  // namespace

std::optional<std::string> code_text(std::string_view raw) {
  constexpr std::string_view kEnds = " \t\r\n";
  const std::size_t begin = raw.find_first_not_of(kEnds);
  if (begin == std::string_view::npos) return std::nullopt;
  raw = raw.substr(begin, raw.find_last_not_of(kEnds) + 1 - begin);
  if (raw.size() > ui::kMostNameBytes || raw.find("://") != std::string_view::npos) return std::nullopt;
  std::string text;
  for (Utf8Letter letter; !raw.empty(); raw.remove_prefix(letter.bytes)) {
    letter = first_letter_of(raw);
    if (letter.bytes == 0 || is_unseen(letter.code)) return std::nullopt;
    if (letter.code == ' ' && text.back() == ' ') continue;
    text += raw.substr(0, letter.bytes);
  }
  return text;
}

CodeScanner::CodeScanner(Appliance& appliance, hal::Device& device)
    : appliance_(appliance), device_(device), look_([this](JobControl& control) {
        const Finally at_the_end{[this] {
          appliance_.session().slot().wipe();  // whoever holds the code is in the pictures, too
          ended_.store(true, std::memory_order_release);
        }};
        return look(control);
      }) {}

CodeScanner::~CodeScanner() {
  if (running_) appliance_.end_side_job(JobLane::Capture);
}

WipedText CodeScanner::turn(const ui::Visit& visit, hal::Instant now) {
  const bool wants = wanted(visit, appliance_);
  // A look begun on the page for a code is none for a name.
  const bool fits = wants && visit.quotes_code() == for_code_;
  WipedText text;
  if (running_ && ended_.load(std::memory_order_acquire)) {
    running_ = false;
    next_try_ = now + kRest;
    if (!appliance_.session().is_open()) appliance_.session().live().wipe();  // else the session does
    text = text_;
    text_.wipe();
  }
  if (running_ && !fits) appliance_.cancel_side_job(JobLane::Capture);
  if (!running_ && wants && now >= next_try_) {
    for_code_ = visit.quotes_code();
    ended_.store(false);
    running_ = appliance_.start_side_job(JobLane::Capture, look_).has_value();
    if (!running_) ended_.store(true);
  }
  if (!fits) text.wipe();  // read in the moment the page was left
  return text;
}

// Left and right by turns: a code may lie in one camera's mirror image of a lamp.
Result<void> CodeScanner::look(JobControl& control) {
  RELIEVO_TRY(appliance_.grabber().start(device_.preferred_mode()));
  for (int pair = 0; !control.cancelled.load(std::memory_order_relaxed); ++pair) {
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame,
                       appliance_.grabber().grab(appliance_.session().slot(), control.cancelled));
    appliance_.session().live().fill(frame.left);
    appliance_.session().live().publish({});
    const auto raw = read_code(pair % 2 == 0 ? frame.left : frame.right);
    const auto text = raw ? code_text(*raw) : std::nullopt;
    if (text && (for_code_ || !is_receipt(*text))) {  // nobody is called as their record's code
      text_ = std::string_view(*text);
      return {};
    }
    std::this_thread::sleep_for(budget::kLivePause);
  }
  return Error{Errc::Cancelled, "no code is looked for any more"};
}

}  // namespace relievo::firmware
