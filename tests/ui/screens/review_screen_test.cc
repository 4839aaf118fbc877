// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the review says of how good the portrait is.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>
#include <string>

#include "pipeline/model/face_model.h"
#include "tests/support/made_screen.h"

namespace relievo::ui {
namespace {

TEST(ReviewScreen, SaysThatASideWasLeftOut) {
  const auto ui = test::make_screen();
  pipeline::FaceModel model(std::pmr::get_default_resource());
  model.quality.coverage = 1;
  model.quality.texture_sharpness = 1;
  ViewState view;
  view.model = &model;
  Visit visit;
  visit.step = Step::Review;
  const auto says = [&](std::string_view words) {
    ui->show(view, visit);
    return std::ranges::any_of(ui->tree().nodes(),
                               [&](const Node& node) { return node.text.starts_with(words); });
  };
  EXPECT_TRUE(says("Very good"));
  model.poses_left_out = 1;
  EXPECT_FALSE(says("Very good"));
  EXPECT_TRUE(says("One side did not fit"));
}

TEST(ReviewScreen, TwoFingersZoomTheModelAndNothingElse) {
  const auto ui = test::make_screen();
  const pipeline::FaceModel model(std::pmr::get_default_resource());
  ViewState view;
  view.model = &model;
  const auto zoom_on = [&](Step step) {
    Visit visit;
    visit.step = step;
    ui->show(view, visit);
    const Node* face = ui->tree().find("face");
    const Rect where = face != nullptr ? face->rect : Rect{0, 0, 1280, 800};
    const float x = where.x + where.w / 2, y = where.y + where.h / 2;
    ui->feed({Input::Kind::Down, 1, x - 30, y}, view);
    ui->feed({Input::Kind::Down, 2, x + 30, y}, view);
    ui->feed({Input::Kind::Move, 2, x + 60, y}, view);
    for (const int finger : {1, 2}) ui->feed({Input::Kind::Up, finger, x, y}, view);
    return ui->visit().look.zoom;
  };
  EXPECT_FLOAT_EQ(zoom_on(Step::Review), 1.5F);
  EXPECT_FLOAT_EQ(zoom_on(Step::Working), 1);
  EXPECT_FLOAT_EQ(zoom_on(Step::Position), 1);
}

// It has lain there for so long that nobody waits for it any more.
TEST(ReviewScreen, AThumbThatRestsOnThePanelIsNoneOfTheTwoFingers) {
  const auto ui = test::make_screen();
  const pipeline::FaceModel model(std::pmr::get_default_resource());
  ViewState view;
  view.model = &model;
  Visit visit;
  visit.step = Step::Review;
  ui->show(view, visit);
  const Rect where = ui->tree().find("face")->rect;
  const float x = where.x + where.w / 2, y = where.y + where.h / 2;
  for (const float thumb_x : {1.0F, x - 100}) {  // beside the model, and on it
    const FaceLook before = ui->visit().look;
    ui->feed({Input::Kind::Down, 1, thumb_x, y}, view);
    view.now += std::chrono::seconds(11);
    ui->feed({Input::Kind::Down, 2, x - 30, y}, view);
    ui->feed({Input::Kind::Down, 3, x + 30, y}, view);
    ui->feed({Input::Kind::Move, 3, x + 60, y}, view);
    EXPECT_FLOAT_EQ(ui->visit().look.zoom, 1.5F * before.zoom);
    ui->feed({Input::Kind::Move, 1, thumb_x + 20, y}, view);
    ui->feed({Input::Kind::Up, 1, thumb_x + 20, y}, view);
    EXPECT_FLOAT_EQ(ui->visit().look.zoom, 1.5F * before.zoom) << "it holds no end of what is zoomed";
    EXPECT_FLOAT_EQ(ui->visit().look.yaw_deg, before.yaw_deg) << "nor does it turn it";
    ui->feed({Input::Kind::Move, 3, x + 30, y}, view);
    EXPECT_FLOAT_EQ(ui->visit().look.zoom, before.zoom) << "and the two still do when it has gone";
    for (const int finger : {2, 3}) ui->feed({Input::Kind::Up, finger, x, y}, view);
  }
}

// A panel that is pulled out, or fails for a moment, never says that the finger on it has gone.
TEST(ReviewScreen, AFingerNobodyHeardOfAgainDoesNotBarTheNext) {
  const auto ui = test::make_screen();
  Visit visit;
  visit.step = Step::Review;
  ViewState view;
  ui->show(view, visit);
  const Rect& button = ui->tree().find("bigger")->rect;
  const float x = button.x + button.w / 2, y = button.y + button.h / 2;
  for (const int finger : {1, 2, 3}) {
    ui->feed({Input::Kind::Down, finger, 1, 1}, view);
    view.now += std::chrono::minutes(1);
    ui->feed({Input::Kind::Down, 10 + finger, x, y}, view);
    ui->feed({Input::Kind::Up, 10 + finger, x, y}, view);
    EXPECT_EQ(ui->visit().text_size, std::size_t(finger));
  }
}

// Only who has no room is told so: another fault is not mended by erasing records.
TEST(ReviewScreen, SaysThatTheMemoryIsFullOnlyWhereItIs) {
  const auto ui = test::make_screen();
  ViewState view;
  Visit visit;
  visit.step = Step::Review;
  const auto told = [&](Trouble trouble) {
    view.trouble = trouble;
    ui->show(view, visit);
    const Node* node = ui->tree().find("trouble");
    return node == nullptr ? std::string() : std::string(node->text);
  };
  EXPECT_EQ(told(Trouble::None), "");
  EXPECT_NE(told(Trouble::StorageFull).find("the memory is full"), std::string::npos);
  EXPECT_EQ(told(Trouble::Storage), "Nothing can be stored at the moment");
}

TEST(TurnScreen, PromisesNothingBeforeItsFirstPicture) {
  const auto ui = test::make_screen();
  ViewState view;
  view.screen = Screen::Turn;
  Visit visit;
  visit.step = Step::Turn;
  ui->show(view, visit);
  EXPECT_EQ(ui->tree().find("oval")->name, "An oval for your face");
  view.live.turn = TurnView{pipeline::TurnAdvice::Hold, 0, 0};
  ui->show(view, visit);
  EXPECT_EQ(ui->tree().find("oval")->name, "Your face is in the oval");
}

// With the setting Automatic it is, without it a button takes it: help holds for both.
TEST(PositionScreen, HelpPromisesNoPictureByItself) {
  const auto ui = test::make_screen();
  ViewState view;
  Visit visit;
  visit.step = Step::Position;
  visit.overlay = Overlay::Help;
  for (const bool by_itself : {true, false}) {
    view.settings.set(Setting::Automatic, by_itself ? 1 : 0);
    ui->show(view, visit);
    ASSERT_NE(ui->tree().find("overlay_text"), nullptr);
    const bool says = std::ranges::any_of(ui->tree().nodes(), [](const Node& node) {
      return node.text.find("taken by itself") != std::string_view::npos;
    });
    EXPECT_FALSE(says);
  }
}

}  // namespace
}  // namespace relievo::ui
