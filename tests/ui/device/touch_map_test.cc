// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/device/touch_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relievo::ui {
namespace {

// A panel that is turned, a little too small and beside; each touch a little off, as fingers are.
std::vector<TouchedCross> touches(const TouchMap& panel_from_picture, float unsteady) {
  std::vector<TouchedCross> all;
  float sign = 1;
  for (const TouchPoint cross : {TouchPoint{0.1F, 0.2F}, {0.9F, 0.2F}, {0.9F, 0.8F}, {0.1F, 0.8F}}) {
    TouchPoint at = panel_from_picture(cross);
    at.x += sign * unsteady;
    at.y -= sign * unsteady;
    sign = -sign;
    all.push_back({at, cross});
  }
  return all;
}

TEST(TouchMapTest, FindsEveryQuarterTurnAndMirrorAndLeavesTheRest) {
  struct Panel {
    TouchMap map;
    double turned_deg;
    bool mirrored;
  };
  // Of the picture, from the panel: the other way round than what the panel does.
  const Panel panels[] = {
      {{{1, 0, 0, 0, 1, 0}}, 0, false},
      {{{0, 1, 0, -1, 0, 1}}, 90, false},
      {{{-1, 0, 1, 0, -1, 1}}, 180, false},
      {{{-1, 0, 1, 0, 1, 0}}, 180, true},
      {{{0.9, 0.05, 0.03, -0.05, 0.9, 0.04}}, std::atan2(0.05, 0.9) * 180 / std::acos(-1.0), false}};
  for (const Panel& panel : panels) {
    const auto fit = fit_touch_map(touches(panel.map, 0.004F));
    ASSERT_TRUE(fit.has_value()) << fit.error().what.view();
    EXPECT_NEAR(std::abs(fit->turned_deg), panel.turned_deg, 0.5);
    EXPECT_EQ(fit->mirrored, panel.mirrored);
    EXPECT_GT(fit->off, 0.001) << "unsteady fingers fit no map exactly";
    for (const TouchPoint at : {TouchPoint{0.5F, 0.5F}, {0.3F, 0.7F}, {0.02F, 0.98F}}) {
      const TouchPoint back = fit->map(panel.map(at));
      EXPECT_NEAR(back.x, at.x, 0.012F);
      EXPECT_NEAR(back.y, at.y, 0.012F);
    }
    const auto read = parse_touch_map(text_of(fit->map));
    ASSERT_TRUE(read.has_value());
    EXPECT_NEAR(read->m[1], fit->map.m[1], 1e-8);
  }
}

TEST(TouchMapTest, WhatIsNoPanelIsRefused) {
  auto all = touches({}, 0);
  EXPECT_FALSE(fit_touch_map(std::span(all).first(2)).has_value()) << "two points leave it open";
  all[2].touched = {0.5F, 0.1F};
  EXPECT_FALSE(fit_touch_map(all).has_value()) << "one beside its cross";
  for (TouchedCross& one : all) one.touched = {one.cross.x, 0.4F};
  EXPECT_FALSE(fit_touch_map(all).has_value()) << "on one line";
  for (TouchedCross& one : all) one.touched = {0.5F + one.cross.x * 0.1F, 0.5F + one.cross.y * 0.1F};
  EXPECT_FALSE(fit_touch_map(all).has_value()) << "a tenth of the screen";
  for (const char* text : {"", "1 1 0 0", "2 1 0 0 0 1 0", "1 1 0 0 0 1 0 7", "1 0 0 0 0 0 0",
                           "1 nan 0 0 0 1 0", "1 1e9 0 0 0 1 0"})
    EXPECT_FALSE(parse_touch_map(text).has_value()) << text;
}

}  // namespace
}  // namespace relievo::ui
