// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visitor: a person before the kiosk on a small simulated rig, who does what each page asks for, from the
// invitation back to the invitation. The visitor's own memory is not the kiosk's: it is not counted.
// Thread: main.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "firmware/kiosk/kiosk.h"
#include "hal/monotonic_clock.h"
#include "hal/sim/device.h"

namespace relievo::test {

struct VisitEnd {
  bool stored = false;                // thanked
  bool apologised = false;            // the page of trouble was there
  bool stuck = false;                 // after five minutes not back at the invitation
  std::chrono::milliseconds told{0};  // from the refused allocation to that page, or to the invitation
};

class Visitor {
 public:
  // Errors: the kiosk's.
  static Result<std::unique_ptr<Visitor>> at(const std::filesystem::path& folder);
  VisitEnd visit();
  // Turns so often with nobody there.
  void nobody(int turns);
  firmware::Kiosk& kiosk() { return *kiosk_; }

 private:
  explicit Visitor(const std::filesystem::path& folder) : folder_(folder) {}
  Result<void> open();
  void turn();
  void tap(std::string_view id);
  void answer(ui::Step step);

  std::filesystem::path folder_;
  hal::MonotonicClock clock_;
  firmware::Console console_;
  firmware::Services services_{.console = console_, .clock = clock_};
  std::unique_ptr<firmware::Kiosk> kiosk_;
  int visits_ = 0;
};

}  // namespace relievo::test
