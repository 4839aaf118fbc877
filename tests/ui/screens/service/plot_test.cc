// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A known series, and where its marks stand in the draw list: by the axis' own numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

class PlotTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(prepare_languages().has_value());
    auto made = TextEngine::make();
    ASSERT_TRUE(made.has_value());
    text = std::move(*made);
  }
  // The marks of one colour, and the field they lie in.
  void draw(const Plot& what, Language language = Language::English) {
    visit.language = language;
    tree.begin(info_of(language).right_to_left);
    view.service = &staff;
    StaffFrame page(tree, view, visit, service, kLight, screen);
    tree.open(page.box(Flow::Column));
    page.plot(what);
    tree.close();
    tree.layout(screen, *text, {});
    list.clear();
    tree.paint(list, *text, {}, kLight.focus, 1);
    for (const Node& node : tree.nodes())
      if (node.spots > 0) field = node.rect;
  }
  std::vector<Rect> marks(Colour colour) const {
    std::vector<Rect> all;
    for (const Command& c : list.commands)
      if (c.mark == Mark::Flat && c.fill == colour && c.rect.x >= field.x - 1) all.push_back(c.rect);
    return all;
  }
  // The value at a height, by the scale.
  double value_at(float y, const PlotScale& scale) const {
    return scale.from + static_cast<double>((field.bottom() - y) / field.h) * (scale.to() - scale.from);
  }
  std::string value_of(std::string_view id) const { return std::string(tree.find(id)->value); }

  ServiceView staff;
  ViewState view;
  Visit visit;
  Service service;
  Tree tree;
  std::unique_ptr<TextEngine> text;
  DrawList list;
  Rect screen{0, 0, 1280, 800}, field;
};

TEST(PlotScale, GoesFromARoundNumberToARoundNumber) {
  const auto is = [](std::vector<float> values, float limit, double from, double step, int steps) {
    const PlotScale scale = plot_scale(values, limit);
    EXPECT_NEAR(scale.from, from, 1e-9);
    EXPECT_NEAR(scale.step, step, 1e-9);
    EXPECT_EQ(scale.steps, steps);
  };
  is({12, 3, 7}, kNone, 0, 5, 3);
  is({100}, kNone, 0, 50, 2);
  is({40}, 90, 0, 50, 2);
  is({0.031F, 0.018F}, kNone, 0, 0.01, 4);
  is({-3, 61}, kNone, -20, 20, 5);
  is({}, kNone, 0, 0.5, 2);
  is({0, 0}, kNone, 0, 0.5, 2);
  is({kNone, 4}, kNone, 0, 1, 4);
  EXPECT_EQ(plot_scale(std::vector{0.031F}, kNone).decimals(), 2);
  EXPECT_EQ(plot_scale(std::vector{12.0F}, kNone).decimals(), 0);
}

TEST_F(PlotTest, BarsAreAsHighAsTheirValuesAndStandInTheirOrder) {
  const std::vector<float> values{4, 0, 12, kNone, 7};
  const std::vector<std::string_view> names{"a", "b", "c", "d", "e"};
  Plot what;
  what.id = "p", what.title = "Visits", what.values = values, what.names = names;
  for (const Language language : {Language::English, Language::Arabic}) {
    draw(what, language);
    const PlotScale scale = plot_scale(values, kNone);
    const auto bars = marks(kLight.accent);
    ASSERT_EQ(bars.size(), 3U) << "nothing stands where there was nothing, or nothing is known";
    const double shown[] = {4, 12, 7};
    const std::size_t places[] = {0, 2, 4};
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_NEAR(value_at(bars[i].y, scale), shown[i], 0.01);
      EXPECT_NEAR(bars[i].bottom(), field.bottom(), 0.01);
      EXPECT_NEAR(bars[i].x + bars[i].w / 2, field.x + field.w * (static_cast<float>(places[i]) + 0.5F) / 5,
                  0.01);
    }
  }
  draw(what);
  EXPECT_EQ(value_of("p"), "Highest: \u2068\u206612\u2069\u2069 (\u2068c\u2069)");
}

TEST_F(PlotTest, TheNumbersOfTheAxisStandAtTheirHeights) {
  const std::vector<float> values{12, 3};
  Plot what;
  what.id = "p", what.values = values;
  draw(what);
  const PlotScale scale = plot_scale(values, kNone);
  int seen = 0;
  for (const Node& node : tree.nodes()) {
    double number = 0;
    if (node.text.empty() || std::sscanf(std::string(node.text).c_str(), "\u2066%lf", &number) != 1) continue;
    EXPECT_NEAR(value_at(node.rect.y + node.rect.h / 2, scale), number,
                1.01 * scale.to() / static_cast<double>(field.h))
        << "to a pixel";
    ++seen;
  }
  EXPECT_EQ(seen, scale.steps + 1);
}

TEST_F(PlotTest, ALineHoldsEachValueAndTheLimitLiesAtItsOwn) {
  const std::vector<float> values{kNone, 40, 60, 95};
  const std::vector<std::string_view> names{"a", "b", "c", "d"};
  Plot what;
  what.id = "p", what.title = "Temperature", what.values = values, what.names = names;
  what.look = PlotLook::Line, what.unit = "°C", what.limit = 90;
  draw(what);
  const PlotScale scale = plot_scale(values, 90);
  const double half_a_pixel = 0.51 * scale.to() / static_cast<double>(field.h);
  const auto steps = marks(kLight.accent);  // 40, 60 and the rise between them
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_NEAR(value_at(steps[0].y + steps[0].h / 2, scale), 40, half_a_pixel);
  EXPECT_NEAR(steps[0].x, field.x + field.w / 4, 0.01);
  EXPECT_NEAR(steps[0].w, field.w / 4, 0.01);
  const Rect& rise = steps[2].h > steps[1].h ? steps[2] : steps[1];
  EXPECT_NEAR(value_at(rise.y, scale), 60, 0.01);
  EXPECT_NEAR(value_at(rise.bottom(), scale), 40, 0.01);
  const auto bad = marks(kLight.bad);  // 95, the rise to it, the limit
  ASSERT_EQ(bad.size(), 3U);
  EXPECT_NEAR(value_at(bad.back().y + bad.back().h / 2, scale), 90, half_a_pixel);
  EXPECT_NEAR(bad.back().w, field.w, 0.01);
  EXPECT_EQ(
      value_of("p"),
      "\u2068\u2068Highest: \u2068\u206695\u00a0°C\u2069\u2069 (\u2068d\u2069)\u2069. \u2068Now\u2069: "
      "\u2068\u206695\u00a0°C\u2069\u2069\u2069. \u2068Limit: \u2068\u206690\u00a0°C\u2069\u2069\u2069");
}

TEST_F(PlotTest, NothingAndOneValueAreToldToo) {
  Plot what;
  what.id = "p", what.title = "Visits", what.figure = "0";
  draw(what);
  EXPECT_TRUE(marks(kLight.accent).empty());
  EXPECT_EQ(value_of("p"), "There is none yet");
  const std::vector<float> one{5};
  const std::vector<std::string_view> name{"today"};
  what.values = one, what.names = name, what.look = PlotLook::Line;
  draw(what);
  ASSERT_EQ(marks(kLight.accent).size(), 1U);
  EXPECT_NEAR(marks(kLight.accent)[0].w, field.w, 0.01);
  EXPECT_EQ(value_of("p"),
            "\u20680\u2069. \u2068Highest: \u2068\u20665\u2069\u2069 (\u2068today\u2069)\u2069");
}

}  // namespace
}  // namespace relievo::ui
