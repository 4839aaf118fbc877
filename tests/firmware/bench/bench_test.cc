// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's picture pages, by touch, on the simulated rig: every page changes something real, and what
// it changed is read back from the object behind it.
#include "tests/firmware/bench/bench_rig.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "firmware/measure/self_agreement.h"
#include "storage/model_blob.h"

namespace relievo::firmware {
namespace {

using test_bench::BenchRig;
using ui::BenchPhase;
using ui::BenchStage;
using ui::StaffPage;

class BenchTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { rig_ = new BenchRig; }
  static void TearDownTestSuite() { delete rig_; }
  static BenchRig& rig() { return *rig_; }
  static bool finished() {
    return rig().now().phase == BenchPhase::Ready || rig().now().phase == BenchPhase::Failed;
  }
  // One is enough for all that only look at it.
  static void capture() {
    rig().open(StaffPage::Stages);
    if (rig().now().phase == BenchPhase::Ready && rig().now().result.algorithms.empty()) return;
    rig().tap("capture");
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().phase, BenchPhase::Ready) << rig().now().problem.detail;
    ASSERT_EQ(rig().now().result.failure.detail, "");
  }
  static void again() {
    rig().tap("run");
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().phase, BenchPhase::Ready) << rig().now().problem.detail;
  }
  static Products& products() { return rig().appliance->session().products(); }
  // The places of an identifier in the choice.
  static std::string kind(std::string_view key) {
    const auto& kinds = rig().now().choice.kinds;
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (kinds[i].key == key) return "kind " + std::to_string(i);
    return "no kind";
  }
  static std::string name(std::string_view algorithm) {
    const auto& names = rig().now().choice.names;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].name == algorithm) return "name " + std::to_string(i);
    return "no name";
  }
  static std::string option(std::string_view key) {
    const auto& options = rig().now().choice.options;
    for (std::size_t i = 0; i < options.size(); ++i)
      if (options[i].key == key) return "option " + std::to_string(i);
    return "no option";
  }

 private:
  static BenchRig* rig_;
};
BenchRig* BenchTest::rig_ = nullptr;

TEST_F(BenchTest, ATestCaptureIsSeenStageByStageAndInNumbers) {
  capture();
  for (std::size_t i = 0; i < ui::kBenchStages; ++i) {
    rig().tap("stage " + std::to_string(i));
    EXPECT_EQ(rig().now().stage, static_cast<BenchStage>(i));
    EXPECT_FALSE(rig().now().shown[0].pixels.empty()) << i;
    EXPECT_EQ(rig().now().shown[1].pixels.empty(), i > 2) << i;
    const auto& drawn =
        rig().screen->draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::BenchLeft)];
    EXPECT_EQ(drawn.version, rig().now().shown[0].version) << i;
  }
  const ui::BenchResult result = rig().now().result;
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
  const ui::BenchRows rows = rig().now().rows;
  ASSERT_EQ(rows.cells.size(), kTableRows * rows.heads.size());
  EXPECT_EQ(rows.cells[0], std::to_string(kTableRows + 1));
  const pipeline::Match& match = products().matches->matches[kTableRows];
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", static_cast<double>(match.disparity_px));
  EXPECT_EQ(rows.cells[4], text);
  rig().tap("table 2");
  for (std::size_t i = 0; i < rig().now().rows.cells.size(); i += 8) {
    for (std::size_t k = 4; k < 7; ++k)
      EXPECT_LE(std::abs(std::stod(std::string(rig().now().rows.cells[i + k]))), 1.0) << "normalised";
  }
  rig().tap("table 3");
  std::snprintf(text, sizeof text, "%.3f", rig().stages->calibration()->left.focal_px.x);
  EXPECT_EQ(rig().now().rows.cells[1], text);
}

TEST_F(BenchTest, ATouchedPointHasItsPartnerAndAHandFindsTheSame) {
  capture();
  rig().tap("stage 2");
  const pipeline::RectifiedPair& pair = *products().pair;
  const auto share = [](double part, double whole) { return static_cast<float>(part / whole); };
  const float x = share(pair.face_centre_px.x, pair.width_px),
              y = share(pair.face_centre_px.y, pair.height_px);
  rig().tap("left", x, y);
  const ui::BenchPoint found = rig().now().point;
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
  const ui::BenchPoint by_hand = rig().now().point;
  ASSERT_TRUE(by_hand.matched && by_hand.by_hand);
  // A finger is a pixel or two off; the likeness is not.
  EXPECT_NEAR(by_hand.disparity_px, found.disparity_px, 2.0);
  EXPECT_NEAR(by_hand.at_mm.z, found.at_mm.z, 8.0);
  EXPECT_GT(by_hand.sigma_mm, 0);
  rig().tap("remove pair");
  rig().tap("by hand");
}

// A wrong patch is planted among the matches; a pair by hand mends it, and what it changed is told.
TEST_F(BenchTest, APairByHandMendsTheSurfaceAndIsMovedRemovedSavedAndLoaded) {
  capture();
  rig().tap("stage 0");
  rig().tap("run from");
  ASSERT_TRUE(rig().until(finished));
  const int width = products().pair->width_px, height = products().pair->height_px;
  const pipeline::Vec2d centre = products().pair->face_centre_px;
  const auto in = [](double part, int whole) { return static_cast<float>(part / whole); };
  const auto depth = [&](float x, float y) {
    const compare::DisparityMap view = compare::model_view(*products().pair, products().model->mesh);
    return products().pair->depth_mm(
        static_cast<double>(view.at(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)))));
  };
  const auto model = [] { return *storage::encode_model(*products().model); };
  const auto calculate = [](const char* button) {
    rig().tap(button);
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().result.failure.detail, "");
  };
  const auto x = static_cast<float>(centre.x) + 0.3F * static_cast<float>(products().pair->face_width_px),
             y = static_cast<float>(centre.y);
  const double right = depth(x, y);
  ASSERT_GT(right, 0);
  for (pipeline::Match& m : products().matches->matches) {
    const double r = std::hypot(static_cast<double>(m.left_px.x - x), static_cast<double>(m.left_px.y - y));
    m.disparity_px += static_cast<float>(3 * std::exp(-r * r / 100));
  }
  rig().tap("stage 5");
  calculate("run from");
  const double wrong = depth(x, y);
  ASSERT_GT(right - wrong, 3) << "millimetres nearer than it is";
  const auto planted = model();

  rig().tap("stage 2");
  rig().tap("by hand");
  rig().tap("left", in(static_cast<double>(x), width), in(static_cast<double>(y), height));
  ASSERT_EQ(rig().now().pairs.size(), 1U);
  ASSERT_TRUE(rig().now().point.matched);
  EXPECT_NEAR(products().pair->depth_mm(static_cast<double>(rig().now().point.disparity_px)), right, 2.0)
      << "what the windows say, not the planted patch";
  EXPECT_TRUE(std::isnan(rig().now().point.moved_mm));
  calculate("run pairs");
  EXPECT_NEAR(depth(x, y), right, (right - wrong) / 4);
  const ui::BenchPoint moved = rig().now().point;
  EXPECT_NEAR(moved.moved_mm, wrong - right, 1.5) << "away";
  EXPECT_NEAR(rig().now().change.farthest_mm, wrong - right, 2.0);
  EXPECT_GT(rig().now().change.moved_mm2, 20);
  EXPECT_TRUE(rig().shows("point moved") && rig().shows("moved"));
  EXPECT_FALSE(rig().shows("run pairs")) << "calculated with";
  rig().tap("stage 6");
  EXPECT_FALSE(rig().now().shown[1].pixels.empty());
  EXPECT_TRUE(rig().shows("change"));

  // Saved, and loaded: the pair with it, the same bits from every stage it has a part in.
  const auto mended = model();
  EXPECT_NE(mended, planted);
  rig().plug_in();
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  rig().plug_in();
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("saved 0");
  ASSERT_TRUE(rig().until([] { return rig().now().phase == BenchPhase::Running; }));
  ASSERT_TRUE(rig().until(finished));
  ASSERT_EQ(rig().now().pairs.size(), 1U) << rig().now().problem.detail;
  EXPECT_EQ(rig().now().pairs[0].disparity_px, moved.disparity_px);
  EXPECT_EQ(model(), mended);
  rig().tap("stage 5");
  calculate("run from");
  EXPECT_EQ(model(), mended);

  // Either end is dragged; removed, the surface is as if it had never been.
  rig().tap("stage 2");
  const ui::BenchPoint before = rig().now().point;
  ASSERT_TRUE(before.touched);
  rig().drag("left", before.left_x, before.y, before.left_x - 0.05F, before.y + 0.03F);
  const ui::BenchPoint dragged = rig().now().point;
  ASSERT_EQ(rig().now().pairs.size(), 1U) << "the same pair";
  EXPECT_NEAR(dragged.left_x, before.left_x - 0.05F, 0.005);
  EXPECT_NEAR(dragged.y, before.y + 0.03F, 0.005);
  rig().drag("right", dragged.right_x, dragged.y, dragged.right_x + 0.1F, dragged.y + 0.2F);
  EXPECT_NEAR(rig().now().point.right_x, dragged.right_x + 0.1F, 0.03) << "to the likeness near the finger";
  EXPECT_EQ(rig().now().point.y, dragged.y) << "on its own row";
  EXPECT_EQ(rig().now().point.left_x, dragged.left_x);
  rig().tap("remove pair");
  EXPECT_TRUE(rig().now().pairs.empty());
  calculate("run pairs");
  EXPECT_EQ(model(), planted);
  rig().tap("by hand");
  rig().tap("capture");
  ASSERT_TRUE(rig().until(finished));
}

TEST_F(BenchTest, AlgorithmsAreChosenEditedComparedAndUsedForVisitors) {
  capture();
  const std::uint64_t accepted = rig().now().result.accepted;
  ASSERT_EQ(rig().now().result.rule_count, 3U);
  rig().open(StaffPage::Compare);
  rig().tap("keep");

  rig().open(StaffPage::Algorithms);
  rig().tap(kind("constraints"));
  rig().tap(name("continuity"));
  EXPECT_EQ(rig().now().choice.kinds[rig().now().choice.kind].value, "similarity+uniqueness");
  EXPECT_TRUE(rig().now().choice.changed);
  rig().tap(kind("matcher"));
  rig().tap(name("zmncc"));
  // An option beyond its bounds is refused and stays; within them it is taken.
  const std::string window = option("zmncc.window_px");
  rig().tap(window);
  for (const char digit : std::string("9999")) rig().tap("type " + std::to_string(static_cast<int>(digit)));
  rig().tap("option use");
  EXPECT_TRUE(rig().shows("option refused"));
  for (int i = 0; i < 4; ++i) rig().tap("type erase");
  for (const char digit : std::string("9")) rig().tap("type " + std::to_string(static_cast<int>(digit)));
  rig().tap("option use");
  EXPECT_FALSE(rig().shows("option use")) << "taken";
  again();
  const ui::BenchView& now = rig().now();
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

TEST_F(BenchTest, ASavedReconstructionComesBackAndIsTheSameCalculatedAgainFromEveryStage) {
  capture();
  const auto model = [] { return *storage::encode_model(*products().model); };
  const auto as_saved = model();
  const ui::BenchResult figures = rig().now().result;
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  ASSERT_EQ(rig().now().recording.outcome, ui::Outcome::Done);
  const std::filesystem::path file = rig().stick() / rig().now().recording.where;
  ASSERT_TRUE(std::filesystem::exists(file)) << rig().now().recording.where;

  // Something else lies there now.
  rig().open(StaffPage::Algorithms);
  rig().tap(kind("mesher"));
  rig().tap(name("delaunay"));
  const float matching = rig().now().result.seconds[0];
  again();
  EXPECT_NE(model(), as_saved);
  EXPECT_EQ(rig().now().result.seconds[0], matching)
      << "the mesher has no part in the matches: they are not made again";
  EXPECT_EQ(rig().now().result.accepted, figures.accepted);

  rig().plug_in();
  rig().open(StaffPage::Stages);
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("leave saved");
  EXPECT_TRUE(rig().shows("capture"));
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("saved 0");
  ASSERT_TRUE(rig().until([] { return rig().now().phase == BenchPhase::Running; }));
  ASSERT_TRUE(rig().until(finished));
  ASSERT_EQ(rig().now().phase, BenchPhase::Ready) << rig().now().problem.detail;
  EXPECT_EQ(model(), as_saved);
  EXPECT_EQ(rig().now().result.algorithms, "") << "its algorithms came with it";
  EXPECT_EQ(rig().now().choice.kinds[rig().now().choice.kind].value, "grid");
  EXPECT_EQ(rig().now().result.seconds, figures.seconds);
  EXPECT_EQ(rig().now().result.made, figures.made);
  EXPECT_EQ(rig().now().result.photo_correlation, figures.photo_correlation);
  for (std::size_t i = 0; i < ui::kBenchStages; ++i) {
    rig().tap("stage " + std::to_string(i));
    EXPECT_FALSE(rig().now().shown[0].pixels.empty()) << i;
  }
  for (const int stage : {7, 6, 5, 4, 0}) {  // texture, surface, points, disparities, pictures
    rig().tap("stage " + std::to_string(stage));
    rig().tap("run from");
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().result.failure.detail, "");
    EXPECT_EQ(model(), as_saved) << stage;
  }

  // What is damaged is refused, and what is there stays.
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("saved 0");
  ASSERT_TRUE(rig().until([] { return !rig().now().problem.empty(); }));
  EXPECT_NE(rig().now().problem.detail.find("damaged"), std::string_view::npos);
  EXPECT_EQ(rig().now().phase, BenchPhase::Ready);
  EXPECT_EQ(model(), as_saved);
}

// Documents and runs in one row: what was put aside stays as it was, and one finger turns all.
TEST_F(BenchTest, FourResultsStandSideBySideAndTurnTogether) {
  capture();
  rig().plug_in();
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  ASSERT_EQ(rig().now().recording.outcome, ui::Outcome::Done);
  const std::string document = std::filesystem::path(rig().now().recording.where).stem().string();
  const std::string taken(rig().now().result.name);
  rig().plug_in();
  rig().open(StaffPage::Compare);
  while (rig().now().stage != BenchStage::Mesh) rig().tap("next stage");
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("saved 0");
  ASSERT_TRUE(rig().until([] { return rig().now().phase == BenchPhase::Running; }));
  ASSERT_TRUE(rig().until(finished));
  ASSERT_EQ(rig().now().put_aside, 1U) << "what was there stands beside the document";
  EXPECT_EQ(rig().now().compared[0].result.name, taken);
  EXPECT_EQ(rig().now().compared[1].result.name, document);
  EXPECT_EQ(rig().now().compared[1].result.made, rig().now().compared[0].result.made);

  rig().tap("keep");
  rig().tap("keep");
  EXPECT_EQ(rig().now().put_aside, 2U) << "the same result once";
  const pipeline::FaceModel as_loaded = *products().model;
  rig().open(StaffPage::Algorithms);
  rig().tap(kind("mesher"));
  rig().tap(name("delaunay"));
  again();
  rig().open(StaffPage::Compare);
  EXPECT_TRUE(rig().shows("option 0")) << "the algorithm that differs has a row";
  rig().tap("keep");
  ASSERT_EQ(rig().now().put_aside, 3U);
  EXPECT_FALSE(rig().shows("keep") || rig().shows("list saved")) << "four is all there is room for";
  const auto& kept = rig().now().compared[1];
  ASSERT_NE(kept.model, nullptr);
  EXPECT_TRUE(
      std::equal(kept.model->mesh.vertices_mm.begin(), kept.model->mesh.vertices_mm.end(),
                 as_loaded.mesh.vertices_mm.begin(), as_loaded.mesh.vertices_mm.end(),
                 [](const auto& a, const auto& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }));
  EXPECT_NE(rig().now().compared[2].result.made[2], kept.result.made[2]);

  for (std::size_t i = 0; i < 3; ++i) {
    const ui::Face& face = rig().screen->draw_list().faces[i];
    EXPECT_EQ(face.version, rig().now().compared[i].model_number);
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(face.version, rig().screen->draw_list().faces[k].version);
  }
  const ui::Node* face = rig().screen->tree().find("kept picture 1");
  ASSERT_NE(face, nullptr);
  const float before = rig().screen->draw_list().face_look.yaw_deg, x = face->rect.x + face->rect.w / 2,
              y = face->rect.y + face->rect.h / 2;
  rig().screen->feed({ui::Input::Kind::Down, 3, x, y}, rig().view);
  rig().screen->feed({ui::Input::Kind::Move, 3, x + 40, y}, rig().view);
  rig().screen->feed({ui::Input::Kind::Up, 3, x + 40, y}, rig().view);
  rig().turn();
  EXPECT_NE(rig().screen->draw_list().face_look.yaw_deg, before);

  const std::uint32_t second = kept.model_number;
  rig().tap("drop 0");
  EXPECT_EQ(rig().now().put_aside, 2U);
  EXPECT_EQ(rig().now().compared[0].model_number, second) << "those behind it move up";
  rig().tap("drop 0");
  rig().tap("drop 0");
  rig().open(StaffPage::Algorithms);
  rig().tap("reset");
}

TEST_F(BenchTest, CamerasAreWatchedOnlyWhileTheirPageIsOpen) {
  rig().open(StaffPage::Cameras);
  ASSERT_TRUE(rig().until([] { return rig().now().cameras.watched && rig().now().cameras.pairs > 1; }))
      << rig().now().problem.detail;
  for (const ui::BenchCamera& camera : rig().now().cameras.camera) {
    EXPECT_FALSE(camera.picture.pixels.empty());
    EXPECT_GT(camera.mean, 0.05F);
    EXPECT_GT(camera.focus, 0.5F);
  }
  rig().open(StaffPage::Stages);
  ASSERT_TRUE(rig().until([] { return !rig().errands->busy(JobPlace::Capture); }));
  EXPECT_FALSE(rig().now().cameras.watched);
  EXPECT_TRUE(rig().now().cameras.camera[0].picture.pixels.empty());
}

// The person is nearer than the room: of the middle of the relief most is known, and bright.
TEST_F(BenchTest, TheReliefStandsBesideTheLivePictureWhenAskedFor) {
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
  const auto& drawn =
      rig().screen->draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::BenchRight)];
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
  ASSERT_TRUE(rig().until([] { return !rig().errands->busy(JobPlace::Capture); }));
}

TEST_F(BenchTest, ACalibrationIsMadeJudgedStoredAndUsed) {
  rig().open(StaffPage::Calibrate);
  rig().tap("columns less");
  EXPECT_EQ(rig().now().calibration.columns, 9);
  rig().tap("columns more");
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.history_count == 1; }));
  rig().tap("calibration begin");
  ASSERT_TRUE(rig().until([] { return rig().appliance->state() == State::Calibrate; }));
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.views > 0; }));
  EXPECT_FALSE(rig().now().calibration.pictures[0].pixels.empty());
  EXPECT_TRUE(rig().shows("advice"));
  ASSERT_TRUE(
      rig().until([] { return rig().now().calibration.views >= 7 || !rig().now().calibration.running; }));
  if (rig().now().calibration.running) rig().tap("calibration finish");
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.ended; }))
      << rig().now().calibration.problem.detail;
  const ui::BenchCalibration made = rig().now().calibration;
  ASSERT_NE(made.verdict, ui::BenchVerdict::Refuse) << (made.reasons.empty() ? "" : made.reasons.front());
  ASSERT_FALSE(made.reasons.empty()) << "good for a reason that is told, too";
  const auto& between = rig().stages->calibration()->right_from_left.translation_mm;
  EXPECT_NEAR(made.baseline_mm, std::hypot(between.x, between.y, between.z), 0.5);
  EXPECT_EQ(rig().appliance->state(), State::Technician);

  rig().tap("calibration store");
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.history_count == 2; }))
      << rig().now().calibration.problem.detail;
  EXPECT_EQ(rig().revision, 2U);
  EXPECT_EQ(rig().stages->calibration()->revision, 2U) << "visitors are measured with it";
  EXPECT_EQ(rig().store->active_calibration()->revision, 2U);
  // The one before it comes back by a touch.
  rig().tap("calibration 1");
  ASSERT_TRUE(rig().until([] { return rig().revision == 1U; })) << rig().now().calibration.problem.detail;
  EXPECT_EQ(rig().stages->calibration()->revision, 1U);
}

// The last: it leaves.
TEST_F(BenchTest, WhoLeavesLeavesNothing) {
  capture();
  rig().open(StaffPage::Compare);
  rig().tap("keep");
  rig().tap("run");  // and goes in the middle of it
  rig().appliance->ask(ui::Intent::LeaveTechnician);
  rig().turn();
  EXPECT_EQ(rig().appliance->state(), State::Idle);
  EXPECT_FALSE(rig().appliance->session().is_open());
  for (const std::byte byte : rig().memory.frames().first(4096)) ASSERT_EQ(byte, std::byte{0});
  EXPECT_EQ(rig().now().phase, BenchPhase::Empty);
  EXPECT_EQ(rig().now().put_aside, 0U);
  EXPECT_TRUE(rig().now().shown[0].pixels.empty() && rig().now().compared[0].picture.pixels.empty());
}

}  // namespace
}  // namespace relievo::firmware
