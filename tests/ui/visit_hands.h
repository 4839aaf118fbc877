// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VisitHands: a visit without a screen: actions and time go in, intents come out.
#pragma once

#include <gtest/gtest.h>

#include "ui/view/visit.h"

namespace relievo::ui {

// Where nobody has set another.
inline const std::chrono::seconds kPatience{Settings().of(Setting::PatienceS)};

class VisitHands : public testing::Test {
 protected:
  VisitHands() {
    view.now = hal::Instant(std::chrono::seconds(1000));
    view.wall_now = std::chrono::system_clock::time_point(std::chrono::seconds(5000));
    machine(Screen::Idle);
  }
  std::optional<Intent> act(ActionKind kind, int value = 0) {
    visit.touched(view.now);
    return visit.act({kind, value}, view);
  }
  std::optional<Intent> machine(Screen screen) {
    view.screen = screen;
    return visit.follow(view);
  }
  std::optional<Intent> pass(std::chrono::milliseconds time) {
    view.now += time;
    return visit.follow(view);
  }
  void to_name() {
    act(ActionKind::Start);
    visit.reads_to_the_end();
    act(ActionKind::Agree);
  }
  // Somebody has that name already.
  void to_known() {
    to_name();
    visit.type("A");
    act(ActionKind::Done);
    view.known = Known::Name;
    pass(std::chrono::milliseconds(1));
    ASSERT_EQ(visit.step, Step::Known);
  }
  void to_position() {
    to_name();
    visit.type("Z");
    ASSERT_EQ(act(ActionKind::Done), Intent::LookUp);
    view.known = Known::Nobody;
    ASSERT_EQ(pass(std::chrono::milliseconds(1)), Intent::Pose);
    machine(Screen::Position);
    ASSERT_EQ(visit.step, Step::Position);
  }
  void to_review() {
    to_position();
    act(ActionKind::TakePicture);
    for (const Screen s :
         {Screen::Capture, Screen::Match, Screen::Reconstruct, Screen::Mesh, Screen::Texture, Screen::Review})
      machine(s);
    ASSERT_EQ(visit.step, Step::Review);
  }

  ViewState view;
  Visit visit;
};

}  // namespace relievo::ui
