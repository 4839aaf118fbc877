// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page that waits for the work does not take the processor from it: its bar grows by steps that are seen.
#include <gtest/gtest.h>

#include "tests/support/made_screen.h"

namespace relievo::ui {
namespace {

TEST(WorkingScreen, ABarThatFillsHasThePageDrawnAHundredTimes) {
  const auto ui = test::make_screen();
  ViewState view;
  Visit visit;
  visit.step = Step::Working;
  int drawn = 0;
  DrawList last;
  for (int i = 0; i <= 5'000; ++i) {
    view.progress = float(i) / 5'000;
    ui->show(view, visit);
    if (ui->draw_list() == last) continue;
    last = ui->draw_list();
    ++drawn;
  }
  EXPECT_LE(drawn, 101);
  EXPECT_GE(drawn, 90) << "nor does it jump";
}

}  // namespace
}  // namespace relievo::ui
