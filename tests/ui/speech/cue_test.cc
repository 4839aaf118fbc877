// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/speech/narrator.h"

#include <gtest/gtest.h>

#include <vector>

#include "ui/technician/technician_view.h"

namespace relievo::ui {
namespace {

// One visit, moment by moment.
class CueTest : public testing::Test {
 protected:
  CueTest() {
    visit.step = Step::Attract;
    view.screen = Screen::Idle;
    (void)hear();
  }
  Cue hear() {
    const Cues now = cues_of(view, visit);
    const Cue heard = cue(before, now);
    before = now;
    return heard;
  }
  Cue at(Screen screen, Step step) {
    view.screen = screen;
    visit.step = step;
    return hear();
  }
  ViewState view;
  Visit visit;
  Cues before;
};

TEST_F(CueTest, AVisitIsHeardOnceEach) {
  EXPECT_EQ(at(Screen::Idle, Step::Consent), Cue::None);
  EXPECT_EQ(at(Screen::Position, Step::Position), Cue::None);
  view.live.advice = pipeline::Advice::None;
  std::vector<int> numbers;
  int ticks = 0;
  for (int ms = 0; ms < 2200; ms += 10) {
    view.live.steady_s = static_cast<float>(ms) / 1000;
    if (hear() != Cue::Tick) continue;
    ++ticks;
    numbers.push_back(before.number);
  }
  EXPECT_EQ(ticks, 3);
  EXPECT_EQ(numbers, (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(at(Screen::Capture, Step::Working), Cue::None) << "nothing has been taken yet";
  EXPECT_EQ(at(Screen::Turn, Step::Turn), Cue::Shutter);
  EXPECT_EQ(hear(), Cue::None);
  view.live.turn = TurnView{pipeline::TurnAdvice::Hold, 25, 0b0001};
  EXPECT_EQ(hear(), Cue::Shutter) << "a side";
  EXPECT_EQ(hear(), Cue::None);
  EXPECT_EQ(at(Screen::Fuse, Step::Working), Cue::None);
  EXPECT_EQ(at(Screen::Review, Step::Review), Cue::None);
  EXPECT_EQ(at(Screen::Store, Step::Working), Cue::None);
  EXPECT_EQ(at(Screen::Idle, Step::Thanks), Cue::Done);
  EXPECT_EQ(hear(), Cue::None);
  EXPECT_EQ(at(Screen::Idle, Step::Attract), Cue::None);
}

TEST_F(CueTest, WhatFailsIsHeardAndIsNoShutter) {
  at(Screen::Position, Step::Position);
  EXPECT_EQ(at(Screen::Capture, Step::Working), Cue::None);
  view.trouble = Trouble::Refused;
  EXPECT_EQ(at(Screen::Position, Step::Position), Cue::Refused) << "once more";
  EXPECT_EQ(at(Screen::Capture, Step::Working), Cue::None);
  EXPECT_EQ(at(Screen::Idle, Step::Trouble), Cue::Refused) << "not at all";
  EXPECT_EQ(at(Screen::Idle, Step::Attract), Cue::None);
  for (const Trouble trouble : {Trouble::Storage, Trouble::StorageFull}) {
    view.trouble = Trouble::None;
    at(Screen::Review, Step::Review);
    view.trouble = trouble;
    EXPECT_EQ(hear(), Cue::Refused);
    EXPECT_EQ(hear(), Cue::None);
    view.trouble = Trouble::Storage;  // as the machine has it once the visitor has left
    EXPECT_EQ(at(Screen::Idle, Step::Attract), Cue::None) << "told already";
  }
  view.trouble = Trouble::None;
  EXPECT_EQ(at(Screen::Idle, Step::Trouble), Cue::None) << "nobody has begun";
}

TEST_F(CueTest, AViewTakenInCalibrationIsHeard) {
  ServiceView service;
  TechnicianView technician;
  service.technician = &technician;
  view.service = &service;
  EXPECT_EQ(hear(), Cue::None);
  technician.calibration.views = 1;
  EXPECT_EQ(hear(), Cue::Taken);
  EXPECT_EQ(hear(), Cue::None);
  technician.calibration.views = 0;
  EXPECT_EQ(hear(), Cue::None) << "another one begins";
}

TEST_F(CueTest, TheGuideRisesAsTheFaceComesRight) {
  at(Screen::Position, Step::Position);
  view.live.advice = pipeline::Advice::OffCentre;
  float before_it = 0;
  for (const float x : {-3.0F, -1.0F, -0.6F, -0.3F, -0.1F}) {
    view.live.face_x = x;
    const auto pitch = guide_pitch(view, visit);
    ASSERT_TRUE(pitch.has_value());
    EXPECT_TRUE(*pitch > before_it || x == -1.0F) << x;
    before_it = *pitch;
  }
  view.live.face_x = 0;
  EXPECT_FLOAT_EQ(*guide_pitch(view, visit), 2);
  view.live.face_y = 0.5F;
  EXPECT_FLOAT_EQ(*guide_pitch(view, visit), 1) << "also up and down";
  for (const auto advice : {pipeline::Advice::None, pipeline::Advice::NoFace, pipeline::Advice::TooDark}) {
    view.live.advice = advice;
    EXPECT_FALSE(guide_pitch(view, visit).has_value());
  }
  // Distance and pose, either way.
  view.live.advice = pipeline::Advice::TooFar;
  EXPECT_FALSE(guide_pitch(view, visit).has_value()) << "not known how far";
  view.live.nearness = 0.75F;
  EXPECT_FLOAT_EQ(*guide_pitch(view, visit), 1);
  view.live.yaw_deg = view.live.pitch_deg = view.live.roll_deg = -22.5F;
  for (const auto advice :
       {pipeline::Advice::TurnedAside, pipeline::Advice::LooksUpOrDown, pipeline::Advice::Tilted}) {
    view.live.advice = advice;
    EXPECT_FLOAT_EQ(*guide_pitch(view, visit), 1);
  }
  view.live.advice = pipeline::Advice::OffCentre;
  visit.step = Step::Review;
  EXPECT_FALSE(guide_pitch(view, visit).has_value());
}

}  // namespace
}  // namespace relievo::ui
