// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/capture_gate.h"

#include <gtest/gtest.h>

#include "hal/sim/head/shape/head_field.h"
#include "tests/support/gate_fixture.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

using test::Developing;
using test::shared_album;
using test::standing;

constexpr std::uint32_t kVisitor = 3;  // not one of those the limits were set with
constexpr GateTime kFrame = std::chrono::milliseconds(66);

// One picture after the other.
struct Rig {
  GateAnswer look(const test::Shot& shot, const Developing& how) {
    const GateLook look = gate.look(shared_album(), shot, how, now, history);
    now += every;
    truth = test::true_head(shot, look.relief);
    return look.answer;
  }
  test::GateFixture gate;
  GateHistory history;
  GateTime now{}, every = kFrame;
  test::TrueHead truth{};
};

hal::sim::HeadPose nobody() {
  hal::sim::HeadPose pose;
  pose.distance_mm = 0;
  return pose;
}

struct Step {
  const char* event;
  hal::sim::HeadPose pose;
  Developing how;
  int pictures;
  Advice expected;  // after the last of them
  test::Extra extra = test::Extra::None;
  test::Guise guise = {};
  Advice reason = Advice::None;  // of the last picture, where what is said has not followed yet
};

// Glasses in which, at `pose` with the head inclined a little, a lamp is mirrored before an eye (or before
// none), by the geometry of lens and lamp.
struct Worn {
  hal::sim::HeadPose pose;
  test::Guise guise;
};
Worn glasses(bool mirror) {
  const hal::sim::HeadField field(hal::sim::traits_of(kVisitor));
  const hal::sim::Vec3 eye = field.eye.centre();
  const hal::sim::Wearer wearer{{eye, {-eye.x, eye.y, eye.z}}, field.eye.radius(), field.traits.head_breadth};
  Worn worn{{}, {{}, true, {}}};
  for (double pitch = -6; pitch <= 6; pitch += 2)
    for (double tilt = 0; tilt <= 9; tilt += 1)
      for (double curve = 80; curve <= 140; curve += 10) {
        worn.pose = standing(560, 0, 0, 0, pitch);
        worn.guise.glasses.tilt_deg = tilt, worn.guise.glasses.curve_mm = curve;
        const double area = mirrored_mm2(wearer, worn.pose, worn.guise.glasses, {0, 0, 0});
        if (mirror ? area > 120 : area < 1) return worn;
      }
  ADD_FAILURE() << "no such glasses";
  return worn;
}

// A visitor walks up, comes too near, stands right, looks aside, the lamps fail and return, one fails, the
// lens fogs, a hand hides the face, a friend looks in, they blink, close their eyes, put on glasses, and they
// leave and come back.
TEST(CaptureGate, TellsAVisitorStepByStepWhatToDo) {
  const hal::sim::HeadPose right = standing(560);
  const Worn mirroring = glasses(true), clear = glasses(false);
  const test::Guise closed{{.lids_open = 0}, false, {}};
  const Step steps[] = {
      {"nobody", nobody(), {}, 2, Advice::NoFace},
      {"too near", standing(400), {}, 3, Advice::TooClose},
      {"stands right", right, {}, 4, Advice::None},
      {"looks aside", standing(560, 0, 0, 25), {}, 3, Advice::TurnedAside},
      {"looks ahead", right, {}, 4, Advice::None},
      {"the lamps fail", right, {.exposure = 0.02}, 3, Advice::TooDark},
      {"the lamps return", right, {}, 4, Advice::None},
      {"too much light", right, {.exposure = 8}, 3, Advice::TooBright},
      {"one lamp fails", right, {.one_sided = 0.02}, 3, Advice::UnevenLight},
      {"it returns, but the lens is fogged", right, {.defocus_px = 3}, 3, Advice::Blurred},
      {"all is well", right, {}, 4, Advice::None},
      {"a hand before the mouth", right, {}, 3, Advice::FaceHidden, test::Extra::HandBefore},
      {"the hand is gone", right, {}, 4, Advice::None},
      {"a friend looks in", standing(560, -40), {}, 3, Advice::MoreThanOneFace, test::Extra::Twin},
      {"the friend has gone", right, {}, 4, Advice::None},
      {"blinks: seen, not yet said", right, {}, 1, Advice::None, {}, closed, Advice::EyesClosed},
      {"looks again", right, {}, 4, Advice::None},
      {"closes the eyes", right, {}, 3, Advice::EyesClosed, {}, closed},
      {"opens them", right, {}, 4, Advice::None},
      {"puts on glasses, which mirror a lamp",
       mirroring.pose,
       {},
       3,
       Advice::GlassesGlare,
       {},
       mirroring.guise},
      {"wears them so that they mirror none", clear.pose, {}, 4, Advice::None, {}, clear.guise},
      {"takes them off", right, {}, 4, Advice::None},
      {"a bag held up beside the head",
       standing(560, -30),
       {},
       3,
       Advice::Background,
       test::Extra::BagBeside},
      {"it is gone", right, {}, 4, Advice::None},
      {"steps out", nobody(), {}, 2, Advice::NoFace},
      {"comes back", right, {}, 4, Advice::None},
  };
  Rig rig;
  std::uint64_t noise = 1;
  for (const Step& step : steps) {
    GateAnswer answer;
    for (int i = 0; i < step.pictures; ++i) {
      Developing how = step.how;
      how.noise_seed = noise++;
      answer = rig.look(shared_album().shoot(kVisitor, step.pose, step.extra, step.guise), how);
      if (step.expected != Advice::None || step.reason != Advice::None) {
        EXPECT_NE(answer.reason, Advice::None) << step.event << ", picture " << i;
      }
    }
    EXPECT_EQ(answer.advice, step.expected)
        << step.event << ": yaw " << answer.measures.head.yaw_deg << " pitch "
        << answer.measures.head.pitch_deg << " light " << answer.measures.light.luminance_mean << " sides "
        << answer.measures.light.side_ratio << " blur " << answer.measures.blur_mm << " eyes "
        << answer.measures.eyes[0].contrast << " " << answer.measures.eyes[1].contrast << " glare "
        << answer.measures.eyes[0].glare_mm2 << " " << answer.measures.eyes[1].glare_mm2 << " beside "
        << answer.measures.beside_share << " speed " << answer.measures.speed_mm_s << " turn "
        << answer.measures.turn_deg_s;
    if (step.reason != Advice::None) {
      EXPECT_EQ(answer.reason, step.reason) << step.event;
    }
    EXPECT_EQ(answer.steady > GateTime{0}, answer.reason == Advice::None) << step.event;
    EXPECT_EQ(answer.reason == Advice::None, step.expected == Advice::None && step.reason == Advice::None)
        << step.event;
  }
}

// Of a face turned far one camera does not see the other cheek: that it is turned, and which way, is all that
// is asked.
TEST(CaptureGate, MeasuresPlaceAndPoseByStereo) {
  for (const double distance_mm : {400.0, 560.0}) {
    Rig rig;
    const GateAnswer answer = rig.look(shared_album().shoot(kVisitor, standing(distance_mm)), {});
    const HeadMeasurement& head = answer.measures.head;
    ASSERT_TRUE(head.known);
    EXPECT_NEAR(head.tip_mm.z, distance_mm - 26, 10);  // the nose before the middle of the face
    EXPECT_NEAR(answer.measures.off_right_mm, 0, 6);
    EXPECT_NEAR(head.yaw_deg, rig.truth.yaw_deg, 5);
    EXPECT_NEAR(head.pitch_deg, rig.truth.pitch_deg, 6);
    EXPECT_NEAR(head.roll_deg, rig.truth.roll_deg, 4);
    EXPECT_GT(head.relief_mm, 15);
  }
  Rig rig;
  const HeadMeasurement turned =
      rig.look(shared_album().shoot(kVisitor, standing(560, 0, 0, 25)), {}).measures.head;
  EXPECT_NEAR(turned.yaw_deg, rig.truth.yaw_deg, 9);
}

TEST(CaptureGate, TheSamePicturesTimeAndHistoryGiveTheSameAnswer) {
  RELIEVO_MANY_TRIALS();
  Rig a, b;
  const test::Shot& shot = shared_album().shoot(kVisitor, standing(560));
  for (int i = 0; i < 2; ++i) {
    const GateAnswer one = a.look(shot, {}), two = b.look(shot, {});
    EXPECT_EQ(one.advice, two.advice);
    EXPECT_EQ(one.measures.head.yaw_deg, two.measures.head.yaw_deg);
    EXPECT_EQ(one.measures.blur_mm, two.measures.blur_mm);
  }
}

// What is measured of a head at rest differs a little from picture to picture, however fast these come.
TEST(CaptureGate, FastPicturesDoNotMakeARestingHeadHurry) {
  RELIEVO_MANY_TRIALS();
  Rig rig;
  rig.every = std::chrono::milliseconds(5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const GateAnswer answer = rig.look(shared_album().shoot(kVisitor, standing(560)), {.noise_seed = seed});
    EXPECT_EQ(answer.reason, Advice::None) << "picture " << seed << ": speed " << answer.measures.speed_mm_s
                                           << " turn " << answer.measures.turn_deg_s;
  }
}

TEST(CaptureGate, FastPicturesOfAMovingHeadSayThatItMoves) {
  Rig rig;
  rig.every = std::chrono::milliseconds(10);
  GateAnswer answer;
  for (int i = 0; i < 12; ++i)
    answer = rig.look(shared_album().shoot(kVisitor, standing(560, -12 + 2.0 * i)),
                      {.noise_seed = static_cast<std::uint64_t>(i + 1)});
  EXPECT_EQ(answer.advice, Advice::Moved);
  EXPECT_NEAR(answer.measures.speed_mm_s, 200, 60) << "a cascade's box moves in steps";
}

TEST(CaptureGate, WithoutItsCascadesItDoesNotOpen) {
  const auto gate = CaptureGate::open({}, "/nonexistent");
  ASSERT_FALSE(gate);
  EXPECT_EQ(gate.error().code, Errc::NotFound);
}

}  // namespace
}  // namespace relievo::pipeline
