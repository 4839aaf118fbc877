// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the review says of how good the portrait is.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>

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

}  // namespace
}  // namespace relievo::ui
