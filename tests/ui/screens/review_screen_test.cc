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
