// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A list whose rows may stretch uses the height there is: its rows grow alike, up to a limit, and never out
// of their card.
#include <gtest/gtest.h>

#include <memory>

#include "ui/tree/tree.h"

namespace relievo::ui {
namespace {

class RowStretchTest : public testing::Test {
 protected:
  void SetUp() override {
    auto made = TextEngine::make();
    ASSERT_TRUE(made.has_value());
    text_ = std::move(*made);
  }
  // A list of four rows of 50 with thin lines between them, in `room` pixels.
  void list_in(float room, float row_stretch) {
    constexpr const char* kRows[] = {"a", "b", "c", "d"};
    tree_.begin(false);
    tree_.open(Node{});
    Node list;
    list.id = "list";
    list.box.grow = 1;
    list.box.pad_y = 8;
    list.box.scroll = list.box.fit_content = true;
    list.box.row_stretch = row_stretch;
    tree_.open(list);
    for (const char* id : kRows) {
      Node row, inside, line;
      row.id = id;
      row.box.flow = Flow::Row;
      inside.box.height = *id == 'd' ? highest_ : 50;
      inside.box.grow = 1;
      line.box.height = 1;
      tree_.open(row);
      tree_.leaf(inside);
      tree_.close();
      tree_.leaf(line);
    }
    tree_.close();
    tree_.close();
    tree_.layout({0, 0, 400, room}, *text_, {});
  }
  Rect at(const char* id) const { return tree_.find(id)->rect; }

  float highest_ = 50;  // of the last row
  std::unique_ptr<TextEngine> text_;
  Tree tree_;
};

constexpr float kLeast = 4 * 51 + 2 * 8;

TEST_F(RowStretchTest, RowsGrowAlikeUpToTheLimitAndTheCardWithThem) {
  list_in(1000, 1.8F);
  for (const char* id : {"a", "b", "c", "d"}) EXPECT_FLOAT_EQ(at(id).h, 90) << id;
  EXPECT_FLOAT_EQ(at("list").h, kLeast + 4 * 40);
  EXPECT_GE(at("b").y, at("a").bottom() + 1);
}

TEST_F(RowStretchTest, AHigherRowGetsNoMoreThanTheOthers) {
  highest_ = 120;
  list_in(1000, 1.8F);
  EXPECT_FLOAT_EQ(at("a").h, 90);
  EXPECT_FLOAT_EQ(at("d").h, 160);
}

TEST_F(RowStretchTest, WithLessRoomTheyFillIt) {
  list_in(kLeast + 100, 1.8F);
  EXPECT_NEAR(at("list").h, kLeast + 100, 4);
  EXPECT_FLOAT_EQ(at("a").h, at("d").h);
  EXPECT_LE(at("d").bottom() + 1 + 8, at("list").bottom() + 1);
}

TEST_F(RowStretchTest, WithoutRoomOrLeaveTheyAreAsHighAsTheirContent) {
  list_in(1000, 1);
  EXPECT_FLOAT_EQ(at("a").h, 50);
  EXPECT_FLOAT_EQ(at("list").h, kLeast);
  list_in(120, 1.8F);
  EXPECT_FLOAT_EQ(at("a").h, 50);
  EXPECT_FLOAT_EQ(tree_.find("list")->content_height, kLeast);
}

}  // namespace
}  // namespace relievo::ui
