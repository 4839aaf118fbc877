// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/drawing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/html_reader.h"

namespace relievo::tests {
namespace {

namespace report = pipeline::report;
using pipeline::Vec2d;

TEST(Drawing, RoundsToOneTwoFive) {
  EXPECT_DOUBLE_EQ(report::rounded_up(0.03), 0.05);
  EXPECT_DOUBLE_EQ(report::rounded_up(0.2), 0.2) << "what is round stays";
  EXPECT_DOUBLE_EQ(report::rounded_up(7), 10);
  EXPECT_DOUBLE_EQ(report::rounded_down(7), 5);
  EXPECT_DOUBLE_EQ(report::rounded_down(1999), 1000);
  EXPECT_DOUBLE_EQ(report::rounded_down(0.001), 0.001);
  for (const double nothing : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_GT(report::rounded_up(nothing), 0) << nothing;
}

TEST(Drawing, TicksCoverARangeInFewSteps) {
  for (double range = 1e-6; range < 1e6; range *= 1.37) {
    const double step = report::tick_step(range, 5);
    EXPECT_LE(range / step, 5.0001) << range;
    EXPECT_GE(range / step, 1.9) << range;
    const double scaled = step * std::pow(10.0, report::tick_decimals(step));
    EXPECT_NEAR(scaled, std::round(scaled), 1e-6) << "the decimals hold the step " << step;
  }
}

// The slow twin: a point is a corner of the hull when all others lie in less than half a turn around it.
bool is_corner(const std::vector<Vec2d>& points, std::size_t which) {
  for (double angle = 0; angle < 6.2832; angle += 0.002) {
    bool outermost = true;
    for (std::size_t i = 0; i < points.size() && outermost; ++i)
      outermost = i == which || (points[i].x - points[which].x) * std::cos(angle) +
                                        (points[i].y - points[which].y) * std::sin(angle) <
                                    0;
    if (outermost) return true;
  }
  return false;
}

TEST(Drawing, HullHoldsTheCornersAndNothingElse) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 100);
  for (int round = 0; round < 5; ++round) {
    std::vector<Vec2d> points;
    for (int i = 0; i < 20; ++i) points.push_back({place(random), place(random)});
    const auto around = report::hull(points);
    std::size_t corners = 0;
    for (std::size_t i = 0; i < points.size(); ++i) corners += is_corner(points, i) ? 1U : 0U;
    EXPECT_EQ(around.size(), corners);
    for (const Vec2d& at : around) {
      const auto found = std::find_if(points.begin(), points.end(),
                                      [&](const Vec2d& p) { return p.x == at.x && p.y == at.y; });
      ASSERT_NE(found, points.end());
      EXPECT_TRUE(is_corner(points, static_cast<std::size_t>(found - points.begin())));
    }
  }
  EXPECT_TRUE(report::hull({}).empty());
  EXPECT_EQ(report::hull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size(), 2U) << "a line has two ends";
}

TEST(Drawing, IsWellFormedWhateverItSays) {
  report::Drawing drawing({100, 50}, "a \"title\" & <more>");
  drawing.text("tick", {1, 2}, "</svg><script>");
  drawing.filled({{0, 0}, {10, 5}}, "#ffffff");
  drawing.line("axis", {std::nan(""), 1}, {-1.25, HUGE_VAL});
  drawing.strokes("none", {});
  const HtmlReader page("<!DOCTYPE html>\n" + drawing.svg());
  EXPECT_EQ(page.error(), "");
  ASSERT_EQ(page.elements().size(), 4U) << "strokes without a stroke are nothing";
  EXPECT_EQ(page.elements()[0].attributes.at("aria-label"), "a \"title\" & <more>");
  EXPECT_EQ(page.elements()[0].attributes.at("viewBox"), "0 0 100 50");
  EXPECT_EQ(page.elements()[3].attributes.at("x2"), "-1.25");
  EXPECT_NE(page.text().find("</svg><script>"), std::string::npos) << "as words";
}

}  // namespace
}  // namespace relievo::tests
