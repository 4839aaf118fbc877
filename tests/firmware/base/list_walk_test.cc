// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/list_walk.h"

#include <gtest/gtest.h>

#include <string>

namespace relievo::firmware {
namespace {

using Ask = ListWalk::Ask;

// Touches until a page is shown: of the stretches that are offered the one that holds it.
int touches_to(ListWalk& walk, std::int64_t page, std::int64_t pages) {
  EXPECT_EQ(walk.ask(ui::DivideList{0, pages - 1}), Ask::Labels);
  for (int touches = 1;; ++touches) {
    const std::size_t count = walk.stretches();
    for (std::size_t i = 0; i < count; ++i) walk.set_label(i, std::to_string(i));
    const ui::ListPlace place = walk.view();
    EXPECT_EQ(place.stretch_count, count);
    std::int64_t next = place.stretches[0].first;
    const ui::ListStretch* chosen = nullptr;
    for (std::size_t i = 0; i < place.stretch_count; ++i) {
      const ui::ListStretch& one = place.stretches[i];
      EXPECT_EQ(one.first, next) << "one after the other, without a gap";
      EXPECT_LE(one.first, one.last);
      next = one.last + 1;
      if (one.first <= page && page <= one.last) chosen = &one;
    }
    if (chosen == nullptr) return 1000;
    if (chosen->first == chosen->last) {
      EXPECT_EQ(walk.ask(ui::GoToPage{chosen->first}), Ask::Rows);
      return touches;
    }
    walk.ask(ui::DivideList{chosen->first, chosen->last});
  }
}

TEST(ListWalk, OfAHundredThousandRecordsAnyPageIsFourTouchesAway) {
  constexpr std::int64_t kPages = 2000;
  ListWalk walk(50);
  walk.set_rows(100'000);
  EXPECT_EQ(walk.view().pages, kPages);
  for (std::int64_t page = 0; page < kPages; ++page) {
    ASSERT_LE(touches_to(walk, page, kPages), 4) << page;
    ASSERT_EQ(walk.view().page, page);
    ASSERT_EQ(walk.first_row(), page * 50);
  }
  EXPECT_EQ(walk.end_row(), 100'000);
}

TEST(ListWalk, AShortListIsOfferedPageByPage) {
  ListWalk walk(10);
  walk.set_rows(25);
  EXPECT_EQ(touches_to(walk, 2, 3), 1);
  EXPECT_EQ(walk.first_row(), 20);
  EXPECT_EQ(walk.end_row(), 25);
}

TEST(ListWalk, WhatIsNotThereLeadsToWhatIsNearest) {
  ListWalk walk(10);
  walk.ask(ui::GoToPage{7});
  EXPECT_EQ(walk.view().page, 0) << "an empty list has its one page";
  EXPECT_EQ(walk.end_row(), 0);
  walk.set_rows(95);
  walk.ask(ui::GoToPage{1000});
  EXPECT_EQ(walk.view().page, 9);
  walk.ask(ui::GoToPage{-3});
  EXPECT_EQ(walk.view().page, 0);
  walk.ask(ui::GoToPage{9});
  walk.set_rows(41);
  EXPECT_EQ(walk.view().page, 4) << "rows went away";
  walk.ask(ui::DivideList{-5, 1'000'000});
  EXPECT_EQ(walk.stretches(), 5U);
  walk.ask(ui::DivideList{4, 2});
  EXPECT_EQ(walk.stretches(), 1U);
}

TEST(ListWalk, AFilterBeginsAtTheFirstPageAndStretchesWaitForTheirLabels) {
  ListWalk walk(10);
  walk.set_rows(1000);
  walk.ask(ui::GoToPage{50});
  EXPECT_EQ(walk.ask(ui::FilterList{2}), Ask::Rows);
  EXPECT_EQ(walk.view().page, 0);
  EXPECT_EQ(walk.view().filter, 2U);
  walk.ask(ui::DivideList{0, 99});
  EXPECT_EQ(walk.view().stretch_count, 0U) << "not known yet";
  for (std::size_t i = 0; i < walk.stretches(); ++i) walk.set_label(i, "2026-03-14");
  EXPECT_EQ(walk.view().stretch_count, 10U);
  EXPECT_EQ(walk.top_row(9), 900);
  walk.forget();
  EXPECT_EQ(walk.view().stretch_count, 0U);
}

}  // namespace
}  // namespace relievo::firmware
