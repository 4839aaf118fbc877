// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "hal/picture_file.h"
#include "pipeline/calibrate/calibrator.h"
#include "tests/support/gate_fixture.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

namespace fs = std::filesystem;
using hal::sim::Expression;
using test::Guise;
using test::standing;

constexpr std::uint32_t kFacePerson = 8;  // not one of those the limits were set with

std::string figures(const GateMeasures& m) {
  char text[240];
  std::snprintf(
      text, sizeof text,
      "eyes: contrast %.2f %.2f, brightness %.2f %.2f, glare %.0f %.0f mm2; mouth: dark %.0f mm2, steps %.1f, before %.1f, rise %.1f mm",
      m.eyes[0].contrast, m.eyes[1].contrast, m.eyes[0].brightness, m.eyes[1].brightness, m.eyes[0].glare_mm2,
      m.eyes[1].glare_mm2, m.mouth.dark_mm2, m.mouth.steps_mm, m.mouth.before_mm, m.mouth.rise_mm);
  return text;
}

// What is said of these eyes and this mouth where all else is right.
Advice said_of(const GateMeasures& m) {
  GateMeasures face = test::good_measures();
  face.eyes = m.eyes, face.mouth = m.mouth;
  return judge(face, Advice::None);
}

struct FaceCase {
  const char* what;
  Guise guise;
  Advice expected;
};

// A few cases of one person; expression_proof has the many.
TEST(GateExpression, TellsEyesMouthAndGlassesApart) {
  RELIEVO_MANY_TRIALS();
  test::Album& album = test::shared_album();
  test::GateFixture gate;
  hal::sim::Glasses dark;
  dark.passes = 0.12;
  for (const FaceCase& c :
       {FaceCase{"at rest", {}, Advice::None}, FaceCase{"dark glasses", {{}, true, dark}, Advice::EyesHidden},
        FaceCase{"eyes closed, a grin", {{0, 7, 1, 0}, false, {}}, Advice::EyesClosed}}) {
    const GateMeasures m =
        gate.first_look(album, album.shoot(kFacePerson, standing(560), test::Extra::None, c.guise))
            .answer.measures;
    ASSERT_TRUE(m.head.known) << c.what;
    EXPECT_EQ(said_of(m), c.expected) << c.what << ": " << figures(m);
    if (c.expected == Advice::EyesClosed) {
      EXPECT_GT(m.mouth.steps_mm, GateLimits{}.steps_mm);
    }
  }
}

// Who turns the head and goes on looking at the cameras shows most of the white of one eye on one side of its
// iris: that is no lamp in glasses.
TEST(GateExpression, AnEyeThatLooksAsideWearsNoGlasses) {
  test::Album& album = test::shared_album();
  test::GateFixture gate;
  for (const double yaw : {18, 19, 20, 21}) {
    const test::Shot shot = album.photograph(303, {yaw, -9, 13, 580, -25, 23});
    for (std::uint64_t noise = 1; noise <= 4; ++noise) {
      test::Developing how;
      how.noise_seed = noise;
      const GateMeasures m = gate.first_look(album, shot, how).answer.measures;
      ASSERT_TRUE(m.head.known) << yaw;
      EXPECT_NE(said_of(m), Advice::GlassesGlare) << yaw << ": " << figures(m);
    }
  }
}

std::optional<StereoCalibration> calibration_of(const fs::path& boards) {
  CalibratorInput input;
  input.pattern = {9, 6, 10};
  for (int i = 0; i < 8; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "%02d.jpg", i);
    const auto left = hal::read_picture(boards / ("left_" + std::string(name))),
               right = hal::read_picture(boards / ("right_" + std::string(name)));
    if (!left || !right) return std::nullopt;
    auto a = find_board(left->view(), input.pattern), b = find_board(right->view(), input.pattern);
    if (!a || !b) continue;
    pair_order(*a, *b, input.pattern);
    input.width_px = left->view().width_px, input.height_px = left->view().height_px;
    input.views.push_back({name, *std::move(a), *std::move(b)});
  }
  auto found = calibrate(input);
  if (!found) return std::nullopt;
  return found->calibration;
}

// Five photographs of one person: 1 grins, 2 and 3 show the tongue, 4 and 5 press the lips. No limit was set
// with them.
TEST(GateExpression, RealFaces) {
  RELIEVO_MANY_TRIALS();
  const char* data = std::getenv("RELIEVO_TEST_DATA");
  if (data == nullptr || !fs::exists(fs::path(data) / "real_faces/face_1"))
    GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the real faces";
  const auto calibration = calibration_of(fs::path(data) / "real_faces/calibration");
  ASSERT_TRUE(calibration);
  test::GateFixture gate(2);  // pictures of 1024 x 1024: the small ones are about as large as a rig's
  for (int i = 1; i <= 5; ++i) {
    const fs::path face = fs::path(data) / "real_faces" / ("face_" + std::to_string(i));
    const auto left = hal::read_picture(face / "left.jpg"), right = hal::read_picture(face / "right.jpg");
    ASSERT_TRUE(left && right) << face;
    const GateMeasures m = gate.first_look({left->view(), right->view()}, *calibration).answer.measures;
    ASSERT_TRUE(m.head.known) << i;
    const Advice said = said_of(m);
    if (i <= 3) {
      EXPECT_TRUE(said == Advice::MouthOpen || said == Advice::NotNeutral)
          << i << ": " << static_cast<int>(said) << "; " << figures(m);
    } else {
      EXPECT_EQ(said, Advice::None) << i << ": " << figures(m);
    }
  }
  // Boards in a hand: no face, no capture.
  for (int i = 0; i < 3; ++i) {
    const fs::path boards = fs::path(data) / "real_faces/calibration";
    const auto left = hal::read_picture(boards / ("left_0" + std::to_string(i) + ".jpg")),
               right = hal::read_picture(boards / ("right_0" + std::to_string(i) + ".jpg"));
    ASSERT_TRUE(left && right);
    EXPECT_NE(gate.first_look({left->view(), right->view()}, *calibration).answer.reason, Advice::None)
        << "board " << i;
  }
}

}  // namespace
}  // namespace relievo::pipeline
