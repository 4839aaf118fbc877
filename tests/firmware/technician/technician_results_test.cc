// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The results of the technician's pages: mended by hand, saved and loaded, beside each other.
#include "tests/firmware/technician/technician_fixture.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/measure/comparison.h"
#include "storage/model_blob.h"

namespace relievo::firmware {
namespace {

// A wrong patch is planted among the matches; a pair by hand mends it, and what it changed is told.
TEST_F(TechnicianTest, APairByHandMendsTheSurfaceAndIsMovedRemovedSavedAndLoaded) {
  capture();
  rig().tap("stage 0");
  rig().tap("run from");
  ASSERT_TRUE(rig().until(finished));
  const int width = products().pair->width_px, height = products().pair->height_px;
  const pipeline::Vec2d centre = products().pair->face_centre_px;
  const auto in = [](double part, int whole) { return float(part / whole); };
  const auto depth = [&](float x, float y) {
    const compare::DisparityMap view = compare::model_view(*products().pair, products().model->mesh);
    return products().pair->depth_mm(double(view.at(int(std::lround(x)), int(std::lround(y)))));
  };
  const auto model = [] { return *storage::encode_model(*products().model); };
  const auto calculate = [](const char* button) {
    rig().tap(button);
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().result.failure.detail, "");
  };
  const auto x = float(centre.x) + 0.3F * float(products().pair->face_width_px), y = float(centre.y);
  const double right = depth(x, y);
  ASSERT_GT(right, 0);
  for (pipeline::Match& m : products().matches->matches) {
    const double r = std::hypot(double(m.left_px.x - x), double(m.left_px.y - y));
    m.disparity_px += float(3 * std::exp(-r * r / 100));
  }
  rig().tap("stage 5");
  calculate("run from");
  const double wrong = depth(x, y);
  ASSERT_GT(right - wrong, 3) << "millimetres nearer than it is";
  const auto planted = model();

  rig().tap("stage 2");
  rig().tap("by hand");
  rig().tap("left", in(double(x), width), in(double(y), height));
  ASSERT_EQ(rig().now().pairs.size(), 1U);
  ASSERT_TRUE(rig().now().point.matched);
  EXPECT_NEAR(products().pair->depth_mm(double(rig().now().point.disparity_px)), right, 2.0)
      << "what the windows say, not the planted patch";
  EXPECT_TRUE(std::isnan(rig().now().point.moved_mm));
  calculate("run pairs");
  EXPECT_NEAR(depth(x, y), right, (right - wrong) / 4);
  const ui::TechnicianPoint moved = rig().now().point;
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
  ASSERT_TRUE(rig().until([] { return rig().now().phase == TechnicianPhase::Running; }));
  ASSERT_TRUE(rig().until(finished));
  ASSERT_EQ(rig().now().pairs.size(), 1U) << rig().now().problem.detail;
  EXPECT_EQ(rig().now().pairs[0].disparity_px, moved.disparity_px);
  EXPECT_EQ(model(), mended);
  EXPECT_FALSE(rig().now().change.known) << "nothing was calculated without the pair here";
  rig().tap("stage 5");
  calculate("run from");
  EXPECT_EQ(model(), mended);
  EXPECT_NEAR(rig().now().change.farthest_mm, wrong - right, 2.0);
  EXPECT_NEAR(rig().now().pairs[0].moved_mm, moved.moved_mm, 0.01);

  // Either end is dragged; removed, the surface is as if it had never been.
  rig().tap("stage 2");
  const ui::TechnicianPoint before = rig().now().point;
  ASSERT_TRUE(before.touched);
  rig().drag("left", before.left_x, before.y, before.left_x - 0.05F, before.y + 0.03F);
  const ui::TechnicianPoint dragged = rig().now().point;
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

// What the page shows is saved: of a pair that waits for its calculation, that it waits.
TEST_F(TechnicianTest, APairThatWasNotCalculatedWithIsSavedAndWhatWasMadeWithoutItIsNot) {
  capture();
  rig().tap("stage 2");
  rig().tap("by hand");
  const pipeline::RectifiedPair& pair = *products().pair;
  rig().tap("left", float(pair.face_centre_px.x / pair.width_px),
            float(pair.face_centre_px.y / pair.height_px));
  const ui::TechnicianPoint set = rig().now().point;
  ASSERT_TRUE(set.matched);
  const auto save = [] {
    rig().plug_in();
    rig().tap("save");
    ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
    ASSERT_EQ(rig().now().recording.outcome, ui::Outcome::Done);
  };
  save();
  const auto waiting = rig().saved_making();
  ASSERT_TRUE(waiting);
  ASSERT_EQ(waiting->by_hand.size(), 1U);
  EXPECT_EQ(waiting->by_hand[0].disparity_px, set.disparity_px);
  EXPECT_EQ(waiting->records.size(), 1U) << "the matches";
  const std::filesystem::path last = rig().stick() / kSavedFolder / "last.relievo";
  std::filesystem::rename(rig().stick() / rig().now().recording.where, last);

  rig().tap("remove pair");
  save();
  const auto without = rig().saved_making();
  ASSERT_TRUE(without);
  EXPECT_TRUE(without->by_hand.empty());
  EXPECT_EQ(without->records.size(), 5U) << "all is as it was calculated";

  rig().plug_in();
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("saved 0");
  ASSERT_TRUE(rig().until([] { return rig().now().phase == TechnicianPhase::Running; }));
  ASSERT_TRUE(rig().until(finished));
  ASSERT_EQ(rig().now().pairs.size(), 1U) << rig().now().problem.detail;
  EXPECT_NE(rig().now().result.failure.detail.find("calculate again"), std::string_view::npos);
  rig().tap("stage 6");
  rig().tap("run from");
  ASSERT_TRUE(rig().until(finished));
  EXPECT_EQ(rig().now().result.failure.detail, "");
  EXPECT_TRUE(products().model.has_value());
  std::filesystem::remove(last);
  rig().tap("stage 2");
  rig().tap("by hand");
  rig().tap("capture");
  ASSERT_TRUE(rig().until(finished));
}

// Names come from a stick that anybody may have written.
TEST_F(TechnicianTest, ManySavedReconstructionsAreListedUnderNamesThatCanBeRead) {
  const std::filesystem::path folder = rig().stick() / kSavedFolder;
  std::filesystem::create_directories(folder);
  const std::vector<std::string> names{"z1\xe2\x80\xaetxt.relievo",
                                       "z2\nline.relievo",
                                       "z3\xff.relievo",
                                       "z4.relievo",
                                       "z5.relievo",
                                       "z6.relievo",
                                       "z7.relievo",
                                       "z8 \xc3\xa9.relievo"};
  for (const std::string& name : names) std::ofstream(folder / name) << "x";
  rig().plug_in();
  rig().open(StaffPage::Stages);
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  ASSERT_GE(rig().now().saved.names.size(), names.size());
  EXPECT_TRUE(rig().shows("saved 7"));
  const char* shown[] = {"z8 \xc3\xa9.relievo", "z7.relievo",  "z6.relievo",      "z5.relievo",
                         "z4.relievo",          "z3?.relievo", "z2?line.relievo", "z1?txt.relievo"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(rig().now().saved.names[i], shown[i]);
  rig().tap("saved 5");
  ASSERT_TRUE(rig().until([] { return !rig().now().problem.empty(); }));
  EXPECT_NE(rig().now().problem.detail.find("z3?.relievo: this is no saved"), std::string_view::npos)
      << rig().now().problem.detail;
  for (const std::string& name : names) std::filesystem::remove(folder / name);
}

TEST_F(TechnicianTest, ASavedReconstructionComesBackAndIsTheSameCalculatedAgainFromEveryStage) {
  capture();
  const auto model = [] { return *storage::encode_model(*products().model); };
  const auto as_saved = model();
  const ui::TechnicianResult figures = rig().now().result;
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
  ASSERT_TRUE(rig().until([] { return rig().now().phase == TechnicianPhase::Running; }));
  ASSERT_TRUE(rig().until(finished));
  ASSERT_EQ(rig().now().phase, TechnicianPhase::Ready) << rig().now().problem.detail;
  EXPECT_EQ(model(), as_saved);
  EXPECT_EQ(rig().now().result.algorithms, "") << "its algorithms came with it";
  EXPECT_EQ(rig().now().choice.kinds[rig().now().choice.kind].value, "grid");
  EXPECT_EQ(rig().now().result.seconds, figures.seconds);
  EXPECT_EQ(rig().now().result.made, figures.made);
  EXPECT_EQ(rig().now().result.photo_correlation, figures.photo_correlation);
  for (std::size_t i = 0; i < std::size_t(TechnicianStage::Poses); ++i) {
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
  EXPECT_EQ(rig().now().problem.code, Errc::InvalidInput) << "the file is, not the store";
  EXPECT_EQ(rig().now().phase, TechnicianPhase::Ready);
  EXPECT_EQ(model(), as_saved);
}

// Documents and runs in one row: what was put aside stays as it was, and one finger turns all.
TEST_F(TechnicianTest, FourResultsStandSideBySideAndTurnTogether) {
  capture();
  rig().plug_in();
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  ASSERT_EQ(rig().now().recording.outcome, ui::Outcome::Done);
  const std::string document = std::filesystem::path(rig().now().recording.where).stem().string();
  const std::string taken(rig().now().result.name);
  rig().plug_in();
  rig().open(StaffPage::Compare);
  while (rig().now().stage != TechnicianStage::Mesh) rig().tap("next stage");
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  rig().tap("saved 0");
  ASSERT_TRUE(rig().until([] { return rig().now().phase == TechnicianPhase::Running; }));
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

  // How far each lies from the present one; a touched one fills the page in these colours.
  rig().tap("show difference");
  ASSERT_TRUE(rig().until([] { return rig().now().compared[2].difference.known; }));
  rig().turn();
  for (std::size_t i = 0; i < 3; ++i) {
    const ui::TechnicianDifference& d = rig().now().compared[i].difference;
    ASSERT_TRUE(d.known && d.colours != nullptr);
    EXPECT_LT(std::abs(d.median_mm), 0.1F) << "of one capture";
    EXPECT_LE(d.most_mm, rig().now().full_colour_mm);
    EXPECT_EQ(rig().screen->draw_list().pictures[std::size_t(ui::PictureSlot::TechnicianLeft) + i].version,
              d.map.version);
  }
  EXPECT_EQ(rig().now().compared[0].difference.most_mm, rig().now().compared[1].difference.most_mm)
      << "the document is what was saved";
  EXPECT_GT(rig().now().compared[0].difference.most_mm, 0) << "of another mesher";
  EXPECT_FALSE(rig().now().compared[3].difference.known) << "the present one";
  rig().tap("kept picture 1");
  EXPECT_EQ(rig().screen->service().mode, 2);
  const auto alone = [] { return rig().screen->draw_list().faces[0]; };
  EXPECT_EQ(alone().model, kept.model);
  EXPECT_EQ(alone().version, rig().now().compared[1].difference.number);
  EXPECT_NE(alone().colours, nullptr);
  rig().tap("show difference");
  EXPECT_EQ(alone().version, kept.model_number);
  EXPECT_EQ(alone().colours, nullptr);
  rig().screen->feed({ui::Input::Kind::Back}, rig().view);
  rig().turn();
  rig().tap("kept picture 1");
  EXPECT_EQ(rig().screen->service().mode, 2) << "the surface, too, by a finger that does not move";
  rig().tap("back");
  EXPECT_EQ(rig().screen->service().mode, 0);

  const std::uint32_t second = kept.model_number;
  rig().tap("drop 0");
  EXPECT_EQ(rig().now().put_aside, 2U);
  EXPECT_EQ(rig().now().compared[0].model_number, second) << "those behind it move up";
  rig().tap("drop 0");
  rig().tap("drop 0");
  rig().open(StaffPage::Algorithms);
  rig().tap("reset");
}

}  // namespace
}  // namespace relievo::firmware
