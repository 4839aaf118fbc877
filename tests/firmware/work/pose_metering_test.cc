// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metered is the face: a simulated person before a window. The room behind them is many times as bright as
// they are, and may burn out.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "firmware/work/jobs.h"
#include "hal/base/statistics.h"
#include "tests/firmware/work/lit_device.h"
#include "tests/support/gate_fixture.h"
#include "tests/support/head_album.h"
#include "tests/support/memory_search.h"

namespace relievo::firmware {
namespace {

constexpr int kAlbumWidth = 480;  // the album's pictures
constexpr std::uint32_t kPerson = 3;
constexpr double kWindowLight = 1;  // white at 10 ms: eight times the face
constexpr double kShade = 0.5;      // of the light the person has in the kiosk's own

double grey(const std::vector<std::uint16_t>& rgb, std::size_t pixel) {
  return (rgb[3 * pixel] + rgb[3 * pixel + 1] + rgb[3 * pixel + 2]) / (3 * test::kLightUnit);
}

// The person as `shade` of their light, and the window wherever the room shows.
std::vector<double> before_window(const std::vector<std::uint16_t>& shot,
                                  const std::vector<std::uint16_t>& room, double shade) {
  std::vector<double> light(shot.size() / 3);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = std::abs(grey(shot, i) - grey(room, i)) < 1e-3 ? kWindowLight : shade * grey(shot, i);
  return light;
}

test::LitDevice::Scene scene(const hal::sim::HeadPose& pose, double shade) {
  const test::Shot& room = test::shared_album().shoot(0, {0, 0, 0, 0, 0, 0});
  const test::Shot& shot = test::shared_album().shoot(kPerson, pose);
  return {before_window(shot.left, room.left, shade), before_window(shot.right, room.right, shade),
          kAlbumWidth};
}

class PoseMetering : public testing::Test {
 protected:
  PoseMetering() {
    auto made = LiveJudge::open(test::shared_album().calibration());
    EXPECT_TRUE(made);
    judge.emplace(*std::move(made));
    pose.emplace(grabber, session, device, pool, &*judge);
    EXPECT_TRUE(session.open("Ada"));
  }
  // `at` says what happens before each picture of the right camera.
  void pose_for(int pictures, const std::function<void(int)>& at = {}) {
    std::atomic<bool> cancelled{false};
    pipeline::Progress progress{};
    int here = 0;
    device.right_camera.on_picture = [&] {
      if (at) at(here);
      if (++here >= pictures) cancelled = true;
    };
    JobControl control{cancelled, progress};
    const auto ended = pose->run(control);
    device.right_camera.on_picture = {};
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, Errc::Cancelled) << ended.error().what.view();
  }
  // The brightest twentieth of the person's skin between brows and mouth, as the right camera shows it: their
  // place is known from the pose.
  double face_shown(double shade) const {
    const test::Shot& shot = test::shared_album().shoot(kPerson, standing);
    const pipeline::StereoCalibration& c = test::shared_album().calibration();
    const pipeline::Vec3d at =
        apply(c.right_from_left, {standing.right_mm, standing.down_mm, standing.distance_mm});
    const double a_mm = c.right.focal_px.x / at.z, x = c.right.centre_px.x + a_mm * at.x,
                 y = c.right.centre_px.y + a_mm * at.y;
    std::vector<double> values;
    for (int v = static_cast<int>(y - 45 * a_mm); v < static_cast<int>(y + 35 * a_mm); ++v)
      for (int u = static_cast<int>(x - 45 * a_mm); u < static_cast<int>(x + 45 * a_mm); ++u)
        values.push_back(shade * grey(shot.right, static_cast<std::size_t>(v * kAlbumWidth + u)) *
                         device.right_camera.factor());
    return percentile(values, 0.95);
  }

  hal::sim::HeadPose standing = test::standing(640, -45, 20);  // not quite in the middle
  test::LitDevice device{scene(standing, kShade), 1};
  BootMemory memory{std::size_t{20} * kAlbumWidth * 300, std::size_t{8} << 20, std::size_t{64} << 20};
  EnrolmentSession session{memory};
  StereoGrabber grabber{device};
  ThreadPool pool{1};
  std::optional<LiveJudge> judge;
  std::optional<PoseJob> pose;
};

TEST_F(PoseMetering, AFaceDarkInABrightRoomIsLitForAndFollowed) {
  pose_for(24);
  ASSERT_TRUE(pose->face());
  EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Settled);
  EXPECT_NEAR(face_shown(kShade), kBrightTarget, 0.2 * kBrightTarget);
  EXPECT_GT(kWindowLight * device.right_camera.factor(), 1) << "the window burns out, and may";
  // The shade grows deeper: the exposure follows the face.
  const double before = device.right_camera.factor();
  test::LitDevice::Scene deeper = scene(standing, kShade / 2);
  device.left_camera.show(deeper.left);
  device.right_camera.show(deeper.right);
  pose_for(24);
  EXPECT_GT(device.right_camera.factor(), 1.5 * before);
  EXPECT_NEAR(face_shown(kShade / 2), kBrightTarget, 0.2 * kBrightTarget);
  // They leave: the room is lit for again.
  const std::vector<double> window(device.left_camera.exposed.empty() ? 0 : std::size_t{kAlbumWidth} * 300,
                                   kWindowLight);
  device.left_camera.show(window);
  device.right_camera.show(window);
  pose_for(24);
  EXPECT_FALSE(pose->face());
  EXPECT_LT(kWindowLight * device.right_camera.factor(), 1);
}

// The judge outlives the visit: of the face it followed nothing may be found once the turn has ended.
TEST_F(PoseMetering, TheShapeOfAFaceThatTurnedIsForgottenWithTheTurn) {
  BootMemory room{std::size_t{20} * kAlbumWidth * 300, std::size_t{1} << 20, std::size_t{1} << 20, 0,
                  std::size_t{80} << 20};
  EnrolmentSession turning{room};
  const hal::sim::PicturePair seen =
      test::shared_album().develop(test::shared_album().shoot(kPerson, standing), {});
  const pipeline::StereoFrame front{seen.left.view(), seen.right.view()};
  std::vector<test::Canary> canaries;
  {
    test::GateFixture gate;
    const pipeline::GateLook look = gate.first_look(front, test::shared_album().calibration());
    const auto face = std::make_unique<pipeline::FrontFace>();
    front_face(look.relief, look.answer.measures.head, *face);
    ASSERT_GT(face->count, 100U);
    canaries.emplace_back("a cheek", std::as_bytes(std::span(face->points).subspan(face->count / 2, 3)));
    explicit_bzero(face.get(), sizeof *face);
  }
  test::MemorySearch search;
  pipeline::Workspace work(1, std::size_t{8} << 20, std::size_t{64} << 20);
  ASSERT_TRUE(*judge->begin_turn(front, work.context));
  EXPECT_FALSE(search.find(canaries).empty()) << "it can be found";
  TurnJob turn(grabber, turning, device, *pose, &*judge);
  turn.begin_with(front);
  turn.finish();
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress{};
  JobControl control{cancelled, progress};
  const auto ended = turn.run(control);
  ASSERT_TRUE(ended) << ended.error().what.view();
  EXPECT_TRUE(search.find(canaries).empty());
}

}  // namespace
}  // namespace relievo::firmware
