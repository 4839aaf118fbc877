// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visitor: people before the kiosk on a small simulated rig, from the invitation back to the invitation, and
// staff. Their own memory is not the kiosk's: it is not counted. Thread: main.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "firmware/kiosk/kiosk.h"
#include "hal/clock.h"
#include "tests/memory/people.h"

namespace relievo::test {

enum class Manner : std::uint8_t {
  Accepts,   // does what each page asks for, and does not turn the head
  Retakes,   // has the picture taken again before accepting
  Declines,  // does not agree
  Leaves,    // from the picture, while the face is made, or from the face
  Unlucky,   // a camera's plug is pulled before the picture
  Turns,     // as who accepts, and turns the head
  Count,
};

constexpr const char* name_of(Manner manner) {
  constexpr std::array kNames{"accepts", "tries again", "declines", "leaves", "a camera is pulled out",
                              "turns"};
  static_assert(kNames.size() == std::size_t(Manner::Count));
  return kNames[std::size_t(manner)];
}

struct VisitEnd {
  bool stored = false;                // thanked
  bool apologised = false;            // the page of trouble was there
  bool stuck = false;                 // after five minutes not back at the invitation
  std::chrono::milliseconds told{0};  // from the refused allocation to that page, or to the invitation
};

class Visitor {
 public:
  // Errors: the kiosk's.
  static Result<std::unique_ptr<Visitor>> at(const std::filesystem::path& folder, std::size_t people = 1);
  // From the opening of the kiosk to its invitation.
  std::chrono::milliseconds until_invited();
  VisitEnd visit(std::size_t person = 0, Manner manner = Manner::Accepts);
  // Staff choose their PINs, and then come again: look at what is to be done, at health and records.
  // False: a page did not come.
  bool first_start();
  bool staff_round();
  // Turns so often with nobody there.
  void nobody(int turns);
  firmware::Kiosk& kiosk() { return *kiosk_; }

 private:
  Visitor(const std::filesystem::path& folder, std::size_t people) : folder_(folder), people_(people) {}
  Result<void> open();
  void turn();
  void tap(std::string_view id);
  void answer(ui::Step step, Manner manner);
  void press(ui::Input::Kind key);
  bool until(const std::function<bool()>& reached);  // within five minutes
  bool knock();
  void type_pin(std::string_view pin);
  bool page(ui::StaffPage wanted);

  std::filesystem::path folder_;
  hal::MonotonicClock clock_;
  People people_;
  firmware::Console console_;
  firmware::Services services_{.console = console_, .clock = clock_};
  std::chrono::steady_clock::time_point opened_;
  std::unique_ptr<firmware::Kiosk> kiosk_;
  int visits_ = 0;
  bool again_ = false;  // the picture was taken a second time
  bool turns_ = false;  // the head, this time
};

}  // namespace relievo::test
