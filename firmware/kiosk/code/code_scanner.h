// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CodeScanner: looks for a QR code with both cameras while a visitor could type: on the page for the name,
// with nothing typed and nothing over it. The job runs on the capture thread beside the states' own and
// gives way to them. Thread: main; the job inside is capture's. Errors: none are told: a camera that does
// not answer is the next page's to say; it is tried again a second later.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/appliance/appliance.h"
#include "hal/base/wiped_text.h"
#include "ui/view/visit.h"

namespace relievo::firmware {

// code_text(): what a QR code says, if it could be a name or a number: strict UTF-8 of 1 to
// ui::kMostNameBytes bytes, spaces put in order, no control, direction or invisible characters, no web
// address. Else nothing. Thread: any.
std::optional<std::string> code_text(std::string_view raw);

class CodeScanner {
 public:
  CodeScanner(Appliance& appliance, hal::Device& device);
  ~CodeScanner();
  CodeScanner& operator=(CodeScanner&&) = delete;

  bool is_looking() const { return running_; }  // its pictures are in the session's live feed
  // Once a frame. Something that was read and could be a name; else empty.
  WipedText turn(const ui::Visit& visit, hal::Instant now);

 private:
  Result<void> look(JobControl& control);

  Appliance& appliance_;
  hal::Device& device_;
  FunctionJob look_;
  std::atomic<bool> ended_{true};
  WipedText text_;         // the job's until it has ended
  bool for_code_ = false;  // the page that was shown when it began; not written while it runs
  bool running_ = false;
  hal::Instant next_try_{};
};

}  // namespace relievo::firmware
