// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is left over is given out to the last pixel; lines and figures are as high and as wide as each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "ui/draw/theme.h"
#include "ui/tree/tree.h"

namespace relievo::ui {
namespace {

class SharesTest : public testing::Test {
 protected:
  void SetUp() override {
    auto made = TextEngine::make();
    ASSERT_TRUE(made.has_value());
    text_ = std::move(*made);
  }
  static Node growing(float share) {
    Node node;
    node.box.grow = share;
    return node;
  }
  // The children of the first node with children of `id`.
  std::vector<Rect> children(std::string_view id) const {
    std::vector<Rect> found;
    const Node* parent = tree_.find(id);
    for (std::int32_t at = parent->first_child; at >= 0;
         at = tree_.nodes()[static_cast<std::size_t>(at)].next)
      found.push_back(tree_.nodes()[static_cast<std::size_t>(at)].rect);
    return found;
  }

  std::unique_ptr<TextEngine> text_;
  Tree tree_;
};

TEST_F(SharesTest, RowsOfAnyNumberOfKeysEndAtTheSamePixel) {
  constexpr const char* kIds[] = {"ten", "eleven", "twelve"};
  for (const float width : {1197.0F, 1200.0F, 733.0F}) {
    for (const bool grid : {false, true}) {
      tree_.begin(false);
      tree_.open(Node{});
      for (int keys = 10; keys <= 12; ++keys) {
        Node row;
        row.id = kIds[keys - 10];
        row.box.flow = Flow::Row;
        row.box.gap = 8;
        row.box.grid = grid;
        row.box.height = 72;
        tree_.open(row);
        for (int i = 0; i < keys; ++i) tree_.leaf(growing(1));
        tree_.close();
      }
      tree_.close();
      tree_.layout({0, 0, width, 400}, *text_, {});
      for (const char* id : kIds) {
        const auto keys = children(id);
        EXPECT_EQ(keys.back().right(), width) << id;
        for (const Rect& key : keys) EXPECT_NEAR(key.w, keys.front().w, 1) << id;
      }
    }
  }
}

TEST_F(SharesTest, ARowHoldsSixteenAndMoreIsABug) {
  const auto row_of = [this](std::size_t count) {
    tree_.begin(false);
    Node row;
    row.id = "row";
    row.box.flow = Flow::Row;
    tree_.open(row);
    for (std::size_t i = 0; i < count; ++i) tree_.leaf(growing(1));
    tree_.close();
    tree_.layout({0, 0, 1600, 400}, *text_, {});
  };
  row_of(kMostInARow);
  for (const Rect& place : children("row")) EXPECT_EQ(place.w, 100);
  EXPECT_DEATH(row_of(kMostInARow + 1), "bug");
}

TEST_F(SharesTest, AKeyOverThreeColumnsCoversTheGapsBetweenThem) {
  tree_.begin(false);
  tree_.open(Node{});
  const auto row_of = [&](const char* id, const std::vector<float>& shares) {
    Node row;
    row.id = id;
    row.box.flow = Flow::Row;
    row.box.gap = 8;
    row.box.grid = true;
    row.box.height = 60;
    tree_.open(row);
    for (const float share : shares) tree_.leaf(growing(share));
    tree_.close();
  };
  row_of("digits", {1, 1, 1, 1});
  row_of("wide", {1, 3});
  tree_.close();
  tree_.layout({0, 0, 754, 200}, *text_, {});
  const auto digits = children("digits"), wide = children("wide");
  EXPECT_EQ(wide[0].right(), digits[0].right());
  EXPECT_EQ(wide[1].x, digits[1].x);
  EXPECT_EQ(wide[1].right(), digits[3].right());
}

TEST_F(SharesTest, CardsOfAnEvenColumnAreAsHighAsEachOtherWhereAllHaveWhatTheyNeed) {
  for (const bool room : {true, false}) {
    tree_.begin(false);
    Node column;
    column.id = "cards";
    column.box.even = true;
    tree_.open(column);
    for (const float need : {40.0F, 160.0F}) {
      Node card = growing(1);
      card.box.min_height = need;
      tree_.leaf(card);
    }
    tree_.close();
    tree_.layout({0, 0, 300, room ? 400.0F : 240.0F}, *text_, {});
    const auto cards = children("cards");
    EXPECT_EQ(cards[0].h == cards[1].h, room);
    EXPECT_GE(cards[1].h, 160);
    EXPECT_EQ(cards[1].bottom(), room ? 400 : 240);
  }
}

TEST_F(SharesTest, LinesAreAsHighAsTheirScriptHasThemWhateverFontTheyComeFrom) {
  const struct {
    const char* language;
    const char* words;
    const type::Lines& lines;
  } cases[] = {{"en", "One moment please", type::kLines},
               {"ar", "لحظة من فضلك", type::kArabicLines},
               {"he", "רק רגע בבקשה", type::kLines},
               {"ja", "少々お待ちください", type::kHanLines}};
  for (const auto& one : cases) {
    TextStyle style;
    style.size_px = 40;
    style.language = one.language;
    const auto high = [&](const std::string& words) { return text_->measure(words, style, 2000).height_px; };
    EXPECT_NEAR(high(one.words), 40 * (one.lines.above + one.lines.below), 2) << one.language;
    EXPECT_NEAR(high(one.words), high("148 220"), 2) << one.language << ": another font stands on the line";
    EXPECT_NEAR(high(std::string(one.words) + "\n" + one.words) - high(one.words), 40 * one.lines.apart, 1)
        << one.language;
  }
}

TEST_F(SharesTest, TabularFiguresStandUnderEachOther) {
  TextStyle style;
  const auto wide = [&](const char* figures) { return text_->measure(figures, style, 800).width_px; };
  EXPECT_GT(wide("20:48:06"), wide("11:11:11") + 4) << "by itself a one is narrow";
  style.tabular = true;
  EXPECT_EQ(wide("20:48:06"), wide("11:11:11"));
}

// What belongs to a picture stands directly above and below it, however much room there is.
TEST_F(SharesTest, ALabelStandsAtItsPicture) {
  for (const float height : {300.0F, 700.0F}) {
    tree_.begin(false);
    Node column;
    column.id = "column";
    column.box.gap = 6;
    column.box.justify = Justify::Centre;
    tree_.open(column);
    Node label;
    label.box.height = 24;
    tree_.leaf(label);
    Node picture = growing(1);
    picture.box.flow = Flow::Stack;
    picture.aspect = 1.6F;
    tree_.leaf(picture);
    tree_.leaf(label);
    tree_.close();
    tree_.layout({0, 0, 400, height}, *text_, {});
    const std::vector<Rect> seen = children("column");
    ASSERT_EQ(seen.size(), 3U);
    EXPECT_NEAR(seen[1].w / seen[1].h, 1.6F, 0.01F);
    EXPECT_NEAR(seen[1].y - seen[0].bottom(), 6, 1) << height;
    EXPECT_NEAR(seen[2].y - seen[1].bottom(), 6, 1) << height;
    EXPECT_NEAR(seen[0].y, height - seen[2].bottom(), 1) << "in the middle of " << height;
  }
}

// A scroller that shrinks is as high as its words, and no higher than what the others leave.
TEST_F(SharesTest, AScrollerThatShrinksIsAsHighAsItsWordsWhereThereIsRoom) {
  for (const float words_px : {120.0F, 900.0F}) {
    tree_.begin(false);
    Node veil;
    veil.box.justify = Justify::Centre;
    tree_.open(veil);
    Node card;
    card.id = "card";
    card.box.shrink = true;
    tree_.open(card);
    Node scroller;
    scroller.id = "words";
    scroller.box.scroll = scroller.box.shrink = true;
    tree_.open(scroller);
    Node words;
    words.box.height = words_px;
    tree_.leaf(words);
    tree_.close();
    Node button;
    button.box.height = 80;
    tree_.leaf(button);
    tree_.close();
    tree_.close();
    tree_.layout({0, 0, 600, 400}, *text_, {});
    const std::vector<Rect> seen = children("card");
    EXPECT_NEAR(seen[0].h, std::min(words_px, 320.0F), 1);
    EXPECT_NEAR(seen[1].h, 80, 1);
    EXPECT_NEAR(tree_.find("card")->rect.y, 400 - tree_.find("card")->rect.bottom(), 1);
    EXPECT_EQ(tree_.find("words")->content_height > tree_.find("words")->rect.h + 1, words_px > 320);
  }
}

}  // namespace
}  // namespace relievo::ui
