// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The address of a portrait is torn only where a line has no room for it.
#include <gtest/gtest.h>

#include "tests/support/made_screen.h"

namespace relievo::ui {
namespace {

constexpr std::string_view kMayEnd = "\u200b";

TEST(ClosingScreens, AnAddressIsDividedOnlyWhereItHasNoRoom) {
  const auto ui = test::make_screen();
  const auto divided = [&](std::string_view link, std::size_t text_size) {
    ViewState view;
    view.receipt = "4821-9037-5512-71";
    view.take_home.link = link;
    Visit visit;
    visit.step = Step::Thanks;
    visit.language = Language::Arabic;
    visit.text_size = text_size;
    ui->show(view, visit);
    const Node* words = ui->tree().find("link_words");
    EXPECT_NE(words, nullptr);
    return words != nullptr && words->text.find(kMayEnd) != std::string_view::npos;
  };
  EXPECT_FALSE(divided("https://faces.example.org/1", 0));
  EXPECT_TRUE(divided("https://faces.example.org/1", 3)) << "in the largest letters";
  EXPECT_TRUE(divided("https://portraits.museum.example.org/1", 0));
}

}  // namespace
}  // namespace relievo::ui
