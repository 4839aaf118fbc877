// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/live_judge.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "firmware/session/session.h"
#include "pipeline/base/workspace.h"

namespace relievo::firmware {
namespace {

using pipeline::Advice;

// Two cameras 120 mm apart, toed in so that their axes meet 560 mm before their middle.
pipeline::StereoCalibration toed_in() {
  pipeline::StereoCalibration c;
  for (auto* camera : {&c.left, &c.right}) {
    camera->focal_px = {3000, 3000};
    camera->centre_px = {960, 600};
    camera->width_px = 1920, camera->height_px = 1200;
  }
  const double turn = 2 * std::atan(60.0 / 560), cosine = std::cos(turn), sine = std::sin(turn);
  c.right_from_left.rotation = {{cosine, 0, sine, 0, 1, 0, -sine, 0, cosine}};
  const pipeline::Vec3d moved =
      apply(c.right_from_left.rotation, {120 * std::cos(turn / 2), 0, 120 * std::sin(turn / 2)});
  c.right_from_left.translation_mm = {-moved.x, -moved.y, -moved.z};
  return c;
}

double middle_x(const FaceBox& box) { return box.x_px + box.width_px / 2.0; }
double middle_y(const FaceBox& box) { return box.y_px + box.height_px / 2.0; }

// Where the axes meet, a face is in the middle of both pictures; half a turn of the cameras leads from the
// left one to the rectified frame.
TEST(LiveJudge, KnowsWhereTheFaceIsInBothPictures) {
  const pipeline::StereoCalibration c = toed_in();
  const double half = std::atan(60.0 / 560), distance = std::hypot(60.0, 560.0);
  const pipeline::Rotation rectified_from_left{
      {std::cos(half), 0, std::sin(half), 0, 1, 0, -std::sin(half), 0, std::cos(half)}};
  const FaceBoxes here = face_boxes(c, rectified_from_left, {60, 0, 560});
  for (const FaceBox& box : {here.left, here.right}) {
    EXPECT_NEAR(middle_x(box), 960, 2);
    EXPECT_NEAR(box.width_px, 3000 * 150 / distance, 2);
    EXPECT_GT(box.height_px, box.width_px);
    EXPECT_LT(middle_y(box), 600) << "the nose is below the middle of the face";
    EXPECT_GT(middle_y(box) + box.height_px / 4.0, 600);
  }
  // 30 mm to the picture's right, in both; nearer, the views part.
  const FaceBoxes right = face_boxes(c, rectified_from_left, {90, 0, 560});
  EXPECT_NEAR(middle_x(right.left), 960 + 3000 * 30 / distance, 12);
  EXPECT_NEAR(middle_x(right.right), 960 + 3000 * 30 / distance, 12);
  const FaceBoxes near = face_boxes(c, rectified_from_left, {60, 0, 450});
  EXPECT_GT(middle_x(near.left), middle_x(here.left) + 50);
  EXPECT_LT(middle_x(near.right), middle_x(here.right) - 50);
}

TEST(LiveJudge, TellsWhichWayToMoveAndHowLongAllIsWell) {
  const pipeline::StereoCalibration c = toed_in();
  pipeline::Relief relief(std::pmr::get_default_resource());
  relief.width_px = 480, relief.height_px = 300;
  pipeline::GateAnswer answer;
  answer.advice = Advice::OffCentre;
  answer.steady = std::chrono::milliseconds(250);
  answer.measures.head.known = true;
  answer.measures.off_right_mm = 75;
  answer.measures.off_down_mm = -30;
  const ui::LiveView by_stereo = guidance_of(answer, c, relief);
  EXPECT_EQ(by_stereo.advice, Advice::OffCentre);
  EXPECT_NEAR(by_stereo.face_x, 0.5, 1e-6);
  EXPECT_NEAR(by_stereo.face_y, -0.2, 1e-6);
  EXPECT_NEAR(by_stereo.steady_s, 0.25, 1e-6);
  EXPECT_NEAR(by_stereo.ideal_width, 3000 * 150 / 563.0 / 1920, 0.01);
  answer.measures.head.known = false;
  answer.measures.face = {{360, 100}, 60};
  const ui::LiveView by_picture = guidance_of(answer, c, relief);
  EXPECT_NEAR(by_picture.face_x, 2, 1e-6);
  EXPECT_NEAR(by_picture.face_y, -50.0 / 60, 1e-6);
  answer.measures.face = {};
  EXPECT_EQ(guidance_of(answer, c, relief).face_x, 0) << "nobody is nowhere";
}

TEST(LiveJudge, WithoutACalibratedPictureNothingIsJudged) {
  auto judge = LiveJudge::open(toed_in());
  ASSERT_TRUE(judge) << judge.error().what.view();
  pipeline::Workspace work(1, 1 << 20, 1 << 20);
  EXPECT_EQ(judge->look({}, {}, work.context).error().code, Errc::InvalidInput);
}

TEST(LiveJudge, GoesByAnotherCalibrationFromThenOn) {
  pipeline::StereoCalibration calibration = toed_in();
  auto judge = LiveJudge::open(calibration);
  ASSERT_TRUE(judge) << judge.error().what.view();
  const std::vector<std::byte> grey(std::size_t{1920} * 1200, std::byte{90});
  const ImageView picture{grey.data(), 1920, 1200, 1920, PixelFormat::Grey8};
  pipeline::Workspace work(1, std::size_t{16} << 20, std::size_t{64} << 20);
  const auto ideal_width = [&] {
    const auto measured = judge->look({picture, picture, 0, 0}, {}, work.context);
    EXPECT_TRUE(measured);
    return measured ? measured->guidance.ideal_width : 0;
  };
  const double before = ideal_width();
  for (auto* camera : {&calibration.left, &calibration.right}) camera->focal_px = {2000, 2000};
  judge->use(calibration);
  EXPECT_NEAR(ideal_width(), before * 2 / 3, 1e-6);
}

TEST(LiveFeed, ShowsACameraPixelByPixelWhereAskedAndForgetsIt) {
  std::vector<std::byte> grey(std::size_t{1920} * 1200);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<std::byte>(i % 251);
  const ImageView camera{grey.data(), 1920, 1200, 1920, PixelFormat::Grey8};
  LiveFeed visitor, technician(budget::kWatchedSidePx);
  EXPECT_EQ(visitor.fill(camera).width_px, budget::kLiveSidePx);
  ASSERT_EQ(technician.fill(camera).width_px, 1920);
  technician.publish({});
  const ui::LiveView live = technician.newest();
  for (int x = 0; x < 1920; x += 7)
    ASSERT_EQ(live.picture.row(1199)[3 * x], camera.row(1199)[x]) << "column " << x;
  technician.wipe();
  EXPECT_TRUE(technician.newest().picture.empty());
  EXPECT_EQ(live.picture.row(1199)[3], 0) << "wiped where it lay";
}

}  // namespace
}  // namespace relievo::firmware
