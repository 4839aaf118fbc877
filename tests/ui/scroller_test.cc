// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is higher than its room: all of it can be reached, and where it goes on it fades.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "ui/tree/tree.h"

namespace relievo::ui {
namespace {

constexpr Rect kScreen{0, 0, 400, 300};
constexpr float kPad = 20, kRow = 60;
constexpr Colour kGround{200, 210, 220, 255}, kRowFill{10, 20, 30, 255};

class ScrollerTest : public testing::Test {
 protected:
  void SetUp() override {
    auto made = TextEngine::make();
    ASSERT_TRUE(made.has_value());
    text_ = std::move(*made);
  }

  // Ten rows in a room for four; `hands` say how far they are scrolled.
  void lay_out(const Interaction& hands) {
    tree_.begin(false);
    Node list;
    list.id = "list";
    list.box.scroll = true;
    list.box.pad_y = kPad;
    list.box.fill = kGround;
    tree_.open(list);
    Node row;
    row.box.height = kRow;
    row.box.fill = kRowFill;
    for (int i = 0; i < 10; ++i) tree_.leaf(row);
    tree_.close();
    tree_.layout(kScreen, *text_, hands);
  }

  Interaction scrolled_to(float px) const {
    Interaction hands;
    hands.scrolled = "list";
    hands.scroll_px = px;
    return hands;
  }

  // What is drawn in the ground's colour behind the last row.
  std::vector<Command> fades(const Interaction& hands) {
    lay_out(hands);
    DrawList list;
    tree_.paint(list, *text_, hands, {}, 1);
    std::vector<Command> found;
    for (const Command& c : list.commands) {
      if (c.fill == kRowFill) found.clear();
      else if (c.fill.with_alpha(0) == kGround.with_alpha(0)) found.push_back(c);
    }
    return found;
  }

  std::unique_ptr<TextEngine> text_;
  Tree tree_;
};

TEST_F(ScrollerTest, ItsEndCanBeReachedWithThePaddingBelowIt) {
  lay_out({});
  const Node& list = tree_.nodes().front();
  const float most = list.content_height - list.rect.h;
  lay_out(scrolled_to(most));
  EXPECT_FLOAT_EQ(tree_.nodes().back().rect.bottom(), kScreen.bottom() - kPad);
}

// A card that fits its content ends with its last row, and takes no more room for it than it was given.
TEST_F(ScrollerTest, ACardThatFitsItsContentEndsWhereItsRowsDo) {
  for (const int rows : {2, 10}) {
    tree_.begin(false);
    tree_.open({});
    Node card;
    card.id = "card";
    card.box.grow = 1;
    card.box.scroll = card.box.fit_content = true;
    card.box.pad_y = kPad;
    tree_.open(card);
    Node row;
    row.box.height = kRow;
    for (int i = 0; i < rows; ++i) tree_.leaf(row);
    tree_.close();
    Node below;
    below.id = "below";
    below.box.height = kRow;
    tree_.leaf(below);
    tree_.close();
    tree_.layout(kScreen, *text_, {});
    EXPECT_EQ(tree_.find("card")->rect.h,
              std::min(2 * kPad + static_cast<float>(rows) * kRow, kScreen.h - kRow));
    EXPECT_EQ(tree_.find("below")->rect.bottom(), kScreen.h) << "what stands below stays at its place";
  }
}

TEST_F(ScrollerTest, FadesBelowWhereMoreLies) {
  const auto found = fades({});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FLOAT_EQ(found[0].rect.bottom(), kScreen.bottom());
  EXPECT_EQ(found[0].fill.a, 0);
  EXPECT_EQ(found[0].fill_end, kGround);
}

TEST_F(ScrollerTest, FadesAboveAtItsEndAndVeilsNothingBelow) {
  const auto found = fades(scrolled_to(1e6F));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FLOAT_EQ(found[0].rect.y, kScreen.y);
  EXPECT_EQ(found[0].fill, kGround);
  EXPECT_EQ(found[0].fill_end.a, 0);
}

// A consent text of 20,000 bytes, in points or as one: all of it that is in the scroller's room is drawn, at
// every place it is scrolled to, and drawing more does not take the room of what is drawn already.
TEST_F(ScrollerTest, ALongTextIsDrawnWhereverItIsScrolled) {
  constexpr Rect kPage{0, 0, 1100, 700};
  constexpr Colour kInk{1, 2, 3, 255};
  for (const std::size_t points : {1U, 8U}) {
    for (const float size_px : {22.0F, 33.0F}) {
      std::string words;
      while (words.size() < 20'000 / points) words += "Read all of this before you agree to it. ";
      const auto lay_out_words = [&](const Interaction& hands) {
        tree_.begin(false);
        Node list;
        list.id = "list";
        list.box.scroll = true;
        tree_.open(list);
        Node point;
        point.text = words;
        point.style.size_px = size_px;
        point.colour = kInk;
        for (std::size_t i = 0; i < points; ++i) tree_.leaf(point);
        tree_.close();
        tree_.layout(kPage, *text_, hands);
      };
      lay_out_words({});
      const float most = tree_.nodes().front().content_height - kPage.h;
      ASSERT_GT(most, kPage.h);
      for (float at = 0; at < most + kPage.h; at += kPage.h) {
        const Interaction hands = scrolled_to(std::min(at, most));
        lay_out_words(hands);
        DrawList list;
        tree_.paint(list, *text_, hands, {}, 1);
        list.clear();
        const std::uint32_t generation = text_->atlas().generation();
        tree_.paint(list, *text_, hands, {}, 1);
        ASSERT_EQ(text_->atlas().generation(), generation) << "what was drawn first has others' letters";
        for (std::size_t i = 1; i < tree_.nodes().size(); ++i) {
          const Rect& box = tree_.nodes()[i].rect;
          // Between its first and its last line letters stand all the way down.
          const float from = std::max(box.y + size_px, 0.0F), to = std::min(box.bottom() - size_px, kPage.h);
          for (float y = from; y < to; ++y) {
            EXPECT_TRUE(std::ranges::any_of(list.commands,
                                            [&](const Command& c) {
                                              return c.fill == kInk && c.rect.holds(box.x + 100, y) &&
                                                     c.uv.h == c.rect.h;
                                            }))
                << points << " points at " << size_px << " px, scrolled to " << at << ": nothing at " << y;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace relievo::ui
