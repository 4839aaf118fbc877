// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's picture pages, by touch, on the simulated rig: every page changes something real, and what
// it changed is read back from the object behind it.
#include "tests/firmware/technician/technician_fixture.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "firmware/measure/comparison.h"
#include "hal/picture_file.h"
#include "hal/recording/capture_file.h"
#include "hal/sim/device.h"

namespace relievo::firmware {
namespace {

constexpr double kTurnedLevels = 4;  // of 255: noise is less

TEST_F(TechnicianTest, ATestCaptureIsSeenStageByStageAndInNumbers) {
  capture();
  for (std::size_t i = 0; i < ui::kTechnicianStages; ++i) {
    rig().tap("stage " + std::to_string(i));
    EXPECT_EQ(rig().now().stage, static_cast<TechnicianStage>(i));
    EXPECT_EQ(rig().now().shown[0].pixels.empty(), i == 8) << "of one pair there are no poses";
    EXPECT_EQ(rig().now().shown[1].pixels.empty(), i > 2) << i;
    const auto& drawn = rig().screen->draw_list().pictures[std::size_t(ui::PictureSlot::TechnicianLeft)];
    EXPECT_EQ(drawn.version, rig().now().shown[0].version) << i;
  }
  const ui::TechnicianResult result = rig().now().result;
  EXPECT_EQ(result.matches, products().matches->matches.size());
  std::uint64_t rejected = 0;
  for (std::size_t i = 0; i < result.rule_count; ++i) rejected += result.rules[i].rejected;
  EXPECT_EQ(result.accepted + rejected, result.matches)
      << "every rejected match has the rule that took it first";
  EXPECT_GT(result.photo_correlation, 0.5F);
  rig().open(StaffPage::Compare);
  EXPECT_TRUE(rig().shows("windows")) << "a correlation says little without the area it is of";
  EXPECT_GT(result.photo_windows, 100U);

  rig().open(StaffPage::Tables);
  rig().tap("table 0");
  rig().tap("page on");
  const ui::TechnicianRows rows = rig().now().rows;
  ASSERT_EQ(rows.cells.size(), kTableRows * rows.heads.size());
  EXPECT_EQ(rows.cells[0], std::to_string(kTableRows + 1));
  const pipeline::Match& match = products().matches->matches[kTableRows];
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", double(match.disparity_px));
  EXPECT_EQ(rows.cells[4], text);
  const std::uint64_t pages = (result.matches + kTableRows - 1) / kTableRows;
  EXPECT_EQ(rig().now().rows.place.pages, std::int64_t(pages));
  rig().tap("filter");
  rig().tap("filter 1");
  EXPECT_EQ(rig().now().rows.place.pages, std::int64_t((result.accepted + kTableRows - 1) / kTableRows));
  for (std::size_t i = 7; i < rig().now().rows.cells.size(); i += 8)
    EXPECT_EQ(rig().now().rows.cells[i], "") << "accepted";
  rig().tap("page number");
  const ui::ListPlace place = rig().now().rows.place;
  ASSERT_EQ(place.stretch_count, ui::kListStretches);
  EXPECT_EQ(place.stretches[9].last, place.pages - 1);
  rig().tap("stretch 9");
  EXPECT_GT(rig().now().rows.place.stretches[0].first, 0);
  const std::int64_t page = rig().now().rows.place.stretches[0].first;
  while (rig().screen->tree().find("stretch 0") != nullptr) rig().tap("stretch 0");
  EXPECT_EQ(rig().now().rows.place.page, page) << "its first page, at last";
  rig().tap("table 2");
  for (std::size_t i = 0; i < rig().now().rows.cells.size(); i += 8) {
    for (std::size_t k = 4; k < 7; ++k)
      EXPECT_LE(std::abs(std::stod(std::string(rig().now().rows.cells[i + k]))), 1.0) << "normalised";
  }
  rig().tap("table 4");
  std::snprintf(text, sizeof text, "%.3f", rig().stages->calibration()->left.focal_px.x);
  EXPECT_EQ(rig().now().rows.cells[1], text);
}

// The cameras are watched until they see it turned: it is rendered first.
void turn_head(TechnicianRig& rig, double yaw_deg) {
  rig.open(StaffPage::Cameras);
  const auto seen = [&] { return rig.now().cameras.camera[0].picture.pixels; };
  ASSERT_TRUE(rig.until([&] { return !seen().empty(); }));
  const auto levels = [&] {
    std::vector<double> all;
    for (int y = 0; y < seen().height_px; y += 8)
      for (int x = 0; x < 3 * seen().width_px; x += 24) all.push_back(double(seen().row(y)[x]));
    return all;
  };
  const std::vector<double> before = levels();
  hal::turn_simulated_head(*rig.device, yaw_deg);
  ASSERT_TRUE(rig.until([&] {
    const std::vector<double> now = levels();
    double apart = 0;
    for (std::size_t i = 0; i < now.size(); ++i) apart += std::abs(now[i] - before[i]);
    return apart > kTurnedLevels * double(now.size());
  }));
  rig.open(StaffPage::Stages);
}

TEST_F(TechnicianTest, SidesBecomeAHeadWhosePosesAreSeen) {
  rig().open(StaffPage::Stages);
  rig().tap("capture");  // a loaded one has no head that could be turned
  ASSERT_TRUE(rig().until(finished));
  ASSERT_TRUE(rig().shows("add side"));
  constexpr double kYaws[] = {24, -22};
  for (std::size_t k = 0; k < 2; ++k) {
    turn_head(rig(), kYaws[k]);
    ASSERT_TRUE(rig().until([&] { return rig().shows("add side"); })) << "once the cameras are not watched";
    rig().tap("add side");
    ASSERT_TRUE(rig().until([&] { return finished() && rig().now().sides == k + 1; }))
        << rig().now().problem.detail;
  }
  turn_head(rig(), 0);
  EXPECT_EQ(rig().now().sides, 2U);
  EXPECT_FALSE(products().registration.has_value());
  // All its pairs go on the stick, the front first.
  rig().plug_in();
  rig().tap("record");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  ASSERT_EQ(rig().now().recording.outcome, ui::Outcome::Done);
  const auto pictures = hal::recorded_pictures(rig().stick() / rig().now().recording.where);
  ASSERT_TRUE(pictures) << pictures.error().what.view();
  ASSERT_EQ(pictures->size(), 6U);
  EXPECT_TRUE(hal::read_capture_file(pictures->front().parent_path() / "capture.json")->head);
  for (std::size_t k = 0; k < 3; ++k) {
    const pipeline::StereoFrame& shot =
        k == 0 ? *products().frame : rig().appliance->session().sides().waiting(k - 1);
    for (std::size_t side = 0; side < 2; ++side) {
      const ImageView& wanted = side == 0 ? shot.left : shot.right;
      const auto seen = hal::read_picture(pictures->at(2 * k + side));
      ASSERT_TRUE(seen && seen->height_px == wanted.height_px && seen->width_px == wanted.width_px);
      const auto row_bytes = std::size_t(wanted.width_px * bytes_per_pixel(wanted.format));
      for (int y = 0; y < wanted.height_px; ++y)
        ASSERT_EQ(std::memcmp(wanted.row(y), seen->view().row(y), row_bytes), 0);
    }
  }
  rig().plug_in();
  const std::size_t before = products().model->mesh.triangles.size();
  again();
  EXPECT_EQ(rig().now().result.failure.detail, "");
  ASSERT_TRUE(products().registration.has_value());
  EXPECT_GT(products().model->mesh.triangles.size(), before / 4);
  EXPECT_EQ(rig().now().sides, 0U) << "the next head has sides of its own";
  rig().tap("stage 8");
  ASSERT_EQ(rig().now().pose_count, 3U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(rig().now().poses[k + 1].joined);
    EXPECT_NEAR(rig().now().poses[k + 1].turned_deg, std::abs(kYaws[k]), 1);
    EXPECT_GT(rig().now().poses[k + 1].rms_mm[0], 0);
    EXPECT_LT(rig().now().poses[k + 1].rms_mm[0], 1);
  }
  for (const auto& picture : rig().now().shown) EXPECT_FALSE(picture.pixels.empty());
  rig().open(StaffPage::Tables);
  rig().tap("table 3");
  ASSERT_EQ(rig().now().rows.cells.size(), 3 * rig().now().rows.heads.size());
  EXPECT_EQ(rig().now().rows.cells[1], "1 – 2");
  EXPECT_NEAR(std::stod(std::string(rig().now().rows.cells[14])), 46, 2) << "between both sides";
  // What is saved of it is the front, as far as that is no part of the head.
  rig().open(StaffPage::Stages);
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  const auto making = rig().saved_making();
  ASSERT_TRUE(making);
  EXPECT_EQ(making->records.size(), 2U);
  rig().plug_in();
  // Without sides it is one pair again.
  rig().tap("run from");
  ASSERT_TRUE(rig().until(finished));
  EXPECT_FALSE(products().registration.has_value());
  EXPECT_EQ(products().model->mesh.triangles.size(), before);
}

TEST_F(TechnicianTest, ATouchedPointHasItsPartnerAndAHandFindsTheSame) {
  capture();
  rig().tap("stage 2");
  const pipeline::RectifiedPair& pair = *products().pair;
  const auto share = [](double part, double whole) { return float(part / whole); };
  const float x = share(pair.face_centre_px.x, pair.width_px),
              y = share(pair.face_centre_px.y, pair.height_px);
  rig().tap("left", x, y);
  const ui::TechnicianPoint found = rig().now().point;
  ASSERT_TRUE(found.matched);
  EXPECT_NEAR(found.left_px.x, pair.face_centre_px.x, 0.02 * pair.width_px);
  // The middle of the face stands where the simulated person stands.
  EXPECT_NEAR(found.at_mm.z, 560, 80);
  EXPECT_GT(found.sigma_mm, 0);
  EXPECT_TRUE(rig().shows("left mark") && rig().shows("right mark"));

  rig().tap("by hand");
  rig().tap("left", share(found.left_px.x, pair.width_px), share(found.left_px.y, pair.height_px));
  EXPECT_TRUE(rig().now().point.matched) << "a partner is proposed";
  EXPECT_NEAR(rig().now().point.disparity_px, found.disparity_px, 2.0);
  rig().tap("right", share(found.right_px.x, pair.width_px), share(found.right_px.y, pair.height_px));
  const ui::TechnicianPoint by_hand = rig().now().point;
  ASSERT_TRUE(by_hand.matched && by_hand.by_hand);
  // A finger is a pixel or two off; the likeness is not.
  EXPECT_NEAR(by_hand.disparity_px, found.disparity_px, 2.0);
  EXPECT_NEAR(by_hand.at_mm.z, found.at_mm.z, 8.0);
  EXPECT_GT(by_hand.sigma_mm, 0);
  rig().tap("remove pair");
  rig().tap("by hand");
}

TEST_F(TechnicianTest, AlgorithmsAreChosenEditedComparedAndUsedForVisitors) {
  capture();
  const std::uint64_t accepted = rig().now().result.accepted;
  ASSERT_EQ(rig().now().result.rule_count, 3U);
  rig().open(StaffPage::Compare);
  rig().tap("keep");

  rig().open(StaffPage::Algorithms);
  rig().tap(kind("constraints"));
  rig().tap(name("continuity"));
  EXPECT_EQ(rig().now().choice.kinds[rig().now().choice.kind].value, "similarity+uniqueness");
  rig().tap(kind("matcher"));
  rig().tap(name("zmncc"));
  // An option beyond its bounds is refused and stays; within them it is taken.
  const std::string window = option("zmncc.window_px");
  rig().tap(window);
  for (const char digit : std::string("9999")) rig().tap("type " + std::to_string(int(digit)));
  rig().tap("option use");
  EXPECT_TRUE(rig().shows("option refused"));
  for (int i = 0; i < 4; ++i) rig().tap("type erase");
  for (const char digit : std::string("9")) rig().tap("type " + std::to_string(int(digit)));
  rig().tap("option use");
  EXPECT_FALSE(rig().shows("option use")) << "taken";
  again();
  const ui::TechnicianView& now = rig().now();
  EXPECT_EQ(now.result.rule_count, 2U);
  EXPECT_NE(now.result.accepted, accepted);
  EXPECT_NE(now.result.algorithms.find("zmncc.window_px = 9"), std::string_view::npos)
      << now.result.algorithms;
  EXPECT_NE(now.result.algorithms.find("matcher = zmncc"), std::string_view::npos);

  rig().open(StaffPage::Compare);
  ASSERT_EQ(rig().now().put_aside, 1U);
  EXPECT_EQ(rig().now().compared[0].result.accepted, accepted) << "the one put aside stays as it was";
  EXPECT_EQ(rig().now().compared[0].result.algorithms, "");
  EXPECT_EQ(rig().now().compared[0].result.name, rig().now().compared[1].result.name) << "the same capture";
  EXPECT_FALSE(rig().now().compared[0].picture.pixels.empty() ||
               rig().now().compared[1].picture.pixels.empty());
  EXPECT_NE(rig().now().compared[0].picture.version, rig().now().compared[1].picture.version);
  rig().tap("drop 0");
  EXPECT_EQ(rig().now().put_aside, 0U);

  rig().open(StaffPage::Algorithms);
  EXPECT_EQ(rig().stages->algorithms().get("matcher"), "refined") << "visitors' are another choice";
  rig().tap("apply");
  ASSERT_TRUE(rig().until([] { return rig().now().applied; })) << rig().now().problem.detail;
  EXPECT_EQ(rig().stages->algorithms().get("zmncc.window_px"), "9");
  const auto kept = pipeline::AlgorithmSet::from_text(*rig().store->setting("algorithms"));
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->get("constraints"), "similarity+uniqueness");
  rig().tap("reset");
  rig().tap("apply");
  ASSERT_TRUE(rig().until([] { return rig().stages->algorithms().get("matcher") == "refined"; }));
}

TEST_F(TechnicianTest, CamerasAreWatchedOnlyWhileTheirPageIsOpen) {
  rig().open(StaffPage::Cameras);
  ASSERT_TRUE(rig().until([] { return rig().now().cameras.watched && rig().now().cameras.pairs > 1; }))
      << rig().now().problem.detail;
  for (const ui::TechnicianCamera& camera : rig().now().cameras.camera) {
    EXPECT_FALSE(camera.picture.pixels.empty());
    EXPECT_GT(camera.mean, 0.05F);
    EXPECT_GT(camera.focus, 0.5F);
  }
  ASSERT_TRUE(rig().until([] { return rig().shows("show edges"); }));
  rig().tap("show edges");
  ASSERT_TRUE(rig().until([] { return rig().now().cameras.camera[1].sharp_edges > 0; }))
      << "a face in focus has some";
  for (const auto& [picture, mode] : {std::pair{"left live", 1}, std::pair{"right live", 2}}) {
    rig().tap(picture);
    EXPECT_EQ(rig().screen->service().mode, mode);
    ASSERT_TRUE(rig().shows("whole"));
    EXPECT_FALSE(rig().shows("left live"));
    const ui::Rect whole = rig().screen->tree().find("whole")->rect;
    EXPECT_GT(whole.h, 0.7F * float(rig().screen->height_px()));
    EXPECT_TRUE(rig().shows("whole focus") && rig().shows("whole edges"));
    if (mode == 1) rig().tap("whole");
    else rig().screen->feed({ui::Input::Kind::Back}, rig().view);
    rig().turn();
    EXPECT_TRUE(rig().shows(picture)) << "back by a tap and by a key";
  }
  rig().tap("show edges");
  ASSERT_TRUE(rig().until([] { return !rig().now().cameras.edges_shown; }));
  rig().tap("watch");
  ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Capture); }));
  EXPECT_TRUE(rig().says("It was stopped"));
  EXPECT_FALSE(rig().says("One moment, please")) << "nothing is on its way";
  EXPECT_EQ(rig().screen->tree().find("watch")->name, "Start");
  rig().tap("watch");
  EXPECT_TRUE(rig().now().cameras.watched || rig().says("One moment, please"));
  EXPECT_EQ(rig().screen->tree().find("watch")->name, "Stop") << "also before the first pair";
  rig().open(StaffPage::Stages);
  ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Capture); }));
  EXPECT_FALSE(rig().now().cameras.watched);
  EXPECT_TRUE(rig().now().cameras.camera[0].picture.pixels.empty());
}

// The person is nearer than the room: of the middle of the relief most is known, and bright.
TEST_F(TechnicianTest, TheReliefStandsBesideTheLivePictureWhenAskedFor) {
  rig().open(StaffPage::Cameras);
  ASSERT_TRUE(rig().until([] { return rig().shows("show relief"); }))
      << rig().now().problem.detail;  // with the first pair
  EXPECT_FALSE(rig().shows("relief"));
  rig().tap("show relief");
  ASSERT_TRUE(rig().until([] { return !rig().now().cameras.relief.pixels.empty(); }))
      << rig().now().cameras.problem.detail;
  rig().turn();
  EXPECT_TRUE(rig().shows("relief") && rig().shows("left live"));
  EXPECT_FALSE(rig().shows("right live"));
  const ImageView relief = rig().now().cameras.relief.pixels;
  int bright = 0, all = 0;
  for (int y = 2 * relief.height_px / 5; y < 3 * relief.height_px / 5; ++y)
    for (int x = 9 * relief.width_px / 20; x < 11 * relief.width_px / 20; ++x, ++all)
      bright += relief.row(y)[3 * x] > 100 ? 1 : 0;
  EXPECT_GT(bright, all / 2);
  const auto& drawn = rig().screen->draw_list().pictures[std::size_t(ui::PictureSlot::TechnicianRight)];
  EXPECT_EQ(drawn.pixels.width_px, relief.width_px);
  EXPECT_EQ(drawn.version & 0x80000000U, 0x80000000U) << "the relief, not the right picture";
  const std::uint32_t first = rig().now().cameras.relief.version;
  ASSERT_TRUE(rig().until([first] { return rig().now().cameras.relief.version > first; }))
      << "drawn with every pair";
  rig().tap("show relief");
  ASSERT_TRUE(rig().until([] { return !rig().now().cameras.relief_shown; }));
  rig().turn();
  EXPECT_TRUE(rig().shows("right live"));
  rig().open(StaffPage::Stages);
  ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Capture); }));
}

// The last: it leaves.
TEST_F(TechnicianTest, WhoLeavesLeavesNothing) {
  capture();
  rig().open(StaffPage::Compare);
  rig().tap("keep");
  rig().tap("run");  // and goes in the middle of it
  rig().appliance->ask(ui::Intent::LeaveStaff);
  rig().turn();
  EXPECT_EQ(rig().appliance->state(), State::Idle);
  EXPECT_FALSE(rig().appliance->session().is_open());
  for (const std::byte byte : rig().memory.frames().first(4096)) ASSERT_EQ(byte, std::byte{0});
  EXPECT_EQ(rig().now().phase, TechnicianPhase::Empty);
  EXPECT_EQ(rig().now().put_aside, 0U);
  EXPECT_TRUE(rig().now().shown[0].pixels.empty() && rig().now().compared[0].picture.pixels.empty());
}

}  // namespace
}  // namespace relievo::firmware
