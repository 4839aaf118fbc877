// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is written on every page against what is painted behind it, in every palette: WCAG 2.2 asks for
// 4.5 : 1, of signs for 3 : 1. Chosen rows, and what a finger is on, are no exception.
#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>

#include "firmware/demo/gallery.h"
#include "tests/support/contrast.h"
#include "tests/support/made_screen.h"
#include "ui/draw/theme.h"

namespace relievo::firmware {
namespace {

using ui::Colour;
using ui::Node;

Colour over(Colour top, Colour below) {
  const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((a * top.a + b * (255 - top.a)) / 255);
  };
  return {mixed(top.r, below.r), mixed(top.g, below.g), mixed(top.b, below.b), 255};
}

// The fills around a node, from the page to it; nothing where a picture lies there, whose colours nobody
// knows.
std::optional<Colour> ground_of(const ui::Tree& tree, const Node& node, bool end, bool touched) {
  std::vector<const Node*> around;
  for (std::int32_t at = static_cast<std::int32_t>(&node - tree.nodes().data()); at >= 0;
       at = tree.nodes()[static_cast<std::size_t>(at)].parent)
    around.insert(around.begin(), &tree.nodes()[static_cast<std::size_t>(at)]);
  std::optional<Colour> ground;
  for (const Node* one : around) {
    if (one->box.flow == ui::Flow::Stack && one->id != "screen") ground.reset();
    Colour fill = end && one->box.fill_end.seen() ? one->box.fill_end : one->box.fill;
    if (!fill.seen()) continue;
    if (touched && one->action.kind != ui::ActionKind::None) fill = ui::pressed(fill);
    if (fill.a == 255) ground = fill;
    else if (ground) ground = over(fill, *ground);
  }
  return ground;
}

class GalleryContrast : public testing::TestWithParam<bool> {};

TEST_P(GalleryContrast, EveryTextCanBeReadAlsoOnAChosenRowAndUnderAFinger) {
  const auto made = test::make_screen();
  ui::Ui& screen = *made;
  screen.resize(1280, 800);
  const ui::ViewState nothing;
  std::size_t texts = 0;
  std::set<std::string> chosen;
  for (const Exhibit& exhibit : gallery(nothing, ui::Language::English, 0, GetParam())) {
    screen.show(exhibit.view, exhibit.visit, exhibit.service);
    for (const Node& node : screen.tree().nodes()) {
      if (node.text.empty() || !screen.tree().is_on_top(node)) continue;
      const ui::Palette& palette = GetParam() ? ui::kHighContrast : ui::kLight;
      // The sign in the middle of a page without rows says nothing that its words do not.
      if (node.role == ui::Role::Icon && node.colour == palette.track) continue;
      const double least = node.role == ui::Role::Icon ? 3 : 4.5;
      for (const bool end : {false, true}) {
        for (const bool touched : {false, true}) {
          const auto ground = ground_of(screen.tree(), node, end, touched);
          if (!ground) continue;
          EXPECT_GE(ui::contrast(node.colour, *ground), least)
              << exhibit.name << ": " << node.text << (touched ? ", touched" : "");
          ++texts;
          if (*ground == palette.accent) chosen.insert(std::string(exhibit.name));
        }
      }
    }
  }
  EXPECT_GT(texts, 5000U);
  for (const char* page : {"technician_algorithms", "technician_matches", "technician_table"})
    EXPECT_EQ(chosen.count(page), 1U) << page << " has a chosen row, which was not looked at";
}

// Where a list goes on its last rows fade. One that is touched there, and is the chosen one then, does not.
TEST_P(GalleryContrast, ARowThatIsTouchedUnderAFadeComesOutFromUnderIt) {
  const auto made = test::make_screen();
  ui::Ui& screen = *made;
  screen.resize(1280, 800);
  const ui::ViewState nothing;
  bool touched = false;
  for (const Exhibit& exhibit : gallery(nothing, ui::Language::English, 0, GetParam())) {
    if (exhibit.name != "technician_algorithms") continue;
    screen.show(exhibit.view, exhibit.visit, exhibit.service);
    const auto clear_of_the_fade = [&](const Node& row) {
      const Node& list = *screen.tree().find("kinds");
      return row.rect.bottom() <= list.rect.bottom() - std::min(56.0F, list.rect.h / 4) + 1;
    };
    for (int kind = 0; kind < 20 && !touched; ++kind) {
      const std::string id = "kind " + std::to_string(kind);
      const Node* row = screen.tree().find(id);
      if (row == nullptr || row->clip.h <= 0 || clear_of_the_fade(*row)) continue;
      touched = true;
      const float x = row->rect.x + row->rect.w / 2, y = row->rect.y + 8;
      screen.feed({ui::Input::Kind::Down, 3, x, y}, exhibit.view);
      screen.feed({ui::Input::Kind::Up, 3, x, y}, exhibit.view);
      screen.show(exhibit.view, exhibit.visit, exhibit.service);
      EXPECT_TRUE(clear_of_the_fade(*screen.tree().find(id))) << id;
    }
  }
  EXPECT_TRUE(touched) << "no row lies under a fade";
}

INSTANTIATE_TEST_SUITE_P(Palettes, GalleryContrast, testing::Bool(),
                         [](const auto& of) { return of.param ? "HighContrast" : "Usual"; });

}  // namespace
}  // namespace relievo::firmware
