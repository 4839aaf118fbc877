// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/judgement.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/support/gate_fixture.h"

namespace relievo::pipeline {
namespace {

using test::good_measures;

struct Row {
  const char* what;
  Advice expected;
  std::function<void(GateMeasures&)> spoil;
};

// In the order in which a person can act: the test below leans on it.
const std::vector<Row>& rows() {
  static const GateLimits l;
  static const std::vector<Row> table{
      {"a friend looks in", Advice::MoreThanOneFace, [](GateMeasures& m) { m.faces = 2; }},
      {"too near", Advice::TooClose, [](GateMeasures& m) { m.head.tip_mm.z = l.nearest_mm - 1; }},
      {"too far", Advice::TooFar, [](GateMeasures& m) { m.head.tip_mm.z = l.farthest_mm + 1; }},
      {"no light at all", Advice::TooDark,
       [](GateMeasures& m) { m.light.luminance_mean = 0.9 * l.lost_dark_mean; }},
      {"nothing but light", Advice::TooBright,
       [](GateMeasures& m) { m.light.bright_share = l.lost_bright_share + 0.01; }},
      {"fog on the lens", Advice::Blurred, [](GateMeasures& m) { m.blur_mm = l.lost_blur_mm + 0.1; }},
      {"a hand before the face", Advice::FaceHidden,
       [](GateMeasures& m) { m.covered_share = l.covered_share + 0.01; }},
      {"to the left", Advice::OffCentre, [](GateMeasures& m) { m.off_right_mm = -l.off_right_mm - 1; }},
      {"too low", Advice::OffCentre, [](GateMeasures& m) { m.off_down_mm = l.off_down_mm + 1; }},
      {"something flat before it", Advice::FaceHidden, [](GateMeasures& m) { m.head.relief_mm = 2; }},
      {"turned", Advice::TurnedAside, [](GateMeasures& m) { m.head.yaw_deg = -l.yaw_deg - 1; }},
      {"bowed", Advice::LooksUpOrDown, [](GateMeasures& m) { m.head.pitch_deg = l.pitch_deg + 1; }},
      {"tilted", Advice::Tilted, [](GateMeasures& m) { m.head.roll_deg = l.roll_deg + 1; }},
      {"moving", Advice::Moved, [](GateMeasures& m) { m.speed_mm_s = l.speed_mm_s + 1; }},
      {"turning", Advice::Moved, [](GateMeasures& m) { m.turn_deg_s = l.turn_deg_s + 1; }},
      {"dark", Advice::TooDark, [](GateMeasures& m) { m.light.luminance_mean = 0.9 * l.darkest_mean; }},
      {"half of it black", Advice::TooDark,
       [](GateMeasures& m) { m.light.dark_share = l.dark_share + 0.01; }},
      {"bright", Advice::TooBright,
       [](GateMeasures& m) { m.light.luminance_mean = l.brightest_mean + 0.01; }},
      {"burnt out", Advice::TooBright, [](GateMeasures& m) { m.light.bright_share = l.bright_share + 0.01; }},
      {"one lamp", Advice::UnevenLight, [](GateMeasures& m) { m.light.side_ratio = l.side_ratio - 0.01; }},
      {"oily", Advice::Highlights, [](GateMeasures& m) { m.light.glossy_share = l.glossy_share + 0.01; }},
      {"out of focus", Advice::Blurred, [](GateMeasures& m) { m.blur_mm = l.blur_mm + 0.05; }},
      {"a hand", Advice::FaceHidden,
       [](GateMeasures& m) { m.head.in_front_share = l.in_front_share + 0.01; }},
      {"hair over one side", Advice::FaceHidden,
       [](GateMeasures& m) { m.head.asymmetry_mm = l.asymmetry_mm + 0.1; }},
      {"dark glasses", Advice::EyesHidden,
       [](GateMeasures& m) { m.eyes[0].brightness = l.eye_brightness - 0.01; }},
      {"eyes closed", Advice::EyesClosed,
       [](GateMeasures& m) { m.eyes[0].contrast = m.eyes[1].contrast = l.iris_contrast - 0.01; }},
      {"a wink", Advice::EyesClosed,
       [](GateMeasures& m) { m.eyes[0].contrast = 0.3, m.eyes[1].contrast = 0.3 * l.one_eye_share - 0.01; }},
      {"a lamp in the glasses", Advice::GlassesGlare,
       [](GateMeasures& m) { m.eyes[0].glare_mm2 = l.glare_mm2 + 1; }},
      {"parted lips", Advice::MouthOpen, [](GateMeasures& m) { m.mouth.dark_mm2 = l.dark_mm2 + 1; }},
      {"teeth", Advice::MouthOpen, [](GateMeasures& m) { m.mouth.steps_mm = l.steps_mm + 0.1; }},
      {"the tongue", Advice::MouthOpen, [](GateMeasures& m) { m.mouth.before_mm = l.before_mm + 0.1; }},
      {"a smile", Advice::NotNeutral, [](GateMeasures& m) { m.mouth.rise_mm = l.rise_mm + 0.1; }},
      {"a bag beside the head", Advice::Background,
       [](GateMeasures& m) { m.beside_share = l.beside_share + 0.01; }},
      {"no cascade sees it", Advice::NoFace, [](GateMeasures& m) { m.tracked = true; }},
  };
  return table;
}

TEST(Judgement, TakesWhoDoesEverythingRight) {
  EXPECT_EQ(judge(good_measures(), Advice::NoFace), Advice::None);
}

TEST(Judgement, EveryFaultAloneGetsItsAdvice) {
  for (const Row& row : rows()) {
    GateMeasures m = good_measures();
    row.spoil(m);
    EXPECT_EQ(judge(m, Advice::None), row.expected) << row.what;
  }
}

// Of two faults, the one a person can mend first. Pairs of the same measure cannot both be.
TEST(Judgement, OfTwoFaultsTheEarlierOneIsSaid) {
  for (std::size_t i = 0; i < rows().size(); ++i)
    for (std::size_t j = i + 1; j < rows().size(); ++j) {
      GateMeasures m = good_measures();
      rows()[i].spoil(m);
      rows()[j].spoil(m);
      if (rows()[i].expected == Advice::TooClose && rows()[j].expected == Advice::TooFar) continue;
      if (rows()[i].expected == Advice::TooDark && rows()[j].expected == Advice::TooBright) continue;
      if (rows()[i].expected == Advice::EyesClosed && rows()[j].expected == Advice::GlassesGlare)
        continue;  // what shines hides the lids
      EXPECT_EQ(judge(m, Advice::None), rows()[i].expected) << rows()[i].what << " and " << rows()[j].what;
    }
}

TEST(Judgement, WhatWasSaidIsNotTakenBackByNoise) {
  const GateLimits l;
  GateMeasures m = good_measures();
  m.head.yaw_deg = l.yaw_deg - 0.5;
  EXPECT_EQ(judge(m, Advice::None), Advice::None);
  EXPECT_EQ(judge(m, Advice::TurnedAside), Advice::TurnedAside);
  m.head.yaw_deg = l.leave_pose * l.yaw_deg - 0.1;
  EXPECT_EQ(judge(m, Advice::TurnedAside), Advice::None);
}

// Place, roll and cover are those of a cheek.
TEST(Judgement, WhoIsTurnedFarIsToldSoBeforeAllElseThatIsMeasuredOfTheFace) {
  const GateLimits l;
  GateMeasures m = good_measures();
  m.turned_far = true;
  m.off_right_mm = 2 * l.off_right_mm, m.head.roll_deg = 2 * l.roll_deg, m.head.in_front_share = 1;
  EXPECT_EQ(judge(m, Advice::None), Advice::TurnedAside);
  m.head.tip_mm.z = l.nearest_mm - 1;
  EXPECT_EQ(judge(m, Advice::None), Advice::TooClose);
}

TEST(Judgement, AnEyeInTheShadeIsNoWink) {
  const GateLimits l;
  GateMeasures m = good_measures();
  m.eyes[1].contrast = l.iris_contrast - 0.01;
  ASSERT_GT(m.eyes[1].contrast, l.one_eye_share * m.eyes[0].contrast);
  EXPECT_EQ(judge(m, Advice::None), Advice::None);
  m.eyes[0].known = false;  // alone it must be seen well
  EXPECT_EQ(judge(m, Advice::None), Advice::EyesClosed);
}

TEST(Judgement, OfEyesThatCannotBeSeenNobodySaysTheyAreClosed) {
  const GateLimits l;
  GateMeasures m = good_measures();
  m.eyes[0].contrast = m.eyes[1].contrast = 0;
  EXPECT_EQ(judge(m, Advice::None), Advice::EyesClosed);
  m.eyes[0].glare_mm2 = l.glare_mm2 + 1;
  EXPECT_EQ(judge(m, Advice::None), Advice::GlassesGlare);
  m.eyes[0].known = m.eyes[1].known = false;
  EXPECT_EQ(judge(m, Advice::None), Advice::None);
}

TEST(Judgement, WithoutAHeadThePictureSpeaks) {
  GateMeasures m;
  EXPECT_EQ(judge(m, Advice::None), Advice::NoFace);
  m.picture_dark_share = 1;
  EXPECT_EQ(judge(m, Advice::None), Advice::TooDark);
  m = {};
  m.middle_bright_share = 0.9;
  EXPECT_EQ(judge(m, Advice::None), Advice::TooBright);
  m = {};
  m.faces = 1;
  m.guessed_mm = 200;
  EXPECT_EQ(judge(m, Advice::None), Advice::TooClose);
  m.guessed_mm = 1500;
  EXPECT_EQ(judge(m, Advice::None), Advice::TooFar);
}

}  // namespace
}  // namespace relievo::pipeline
