// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The address of a portrait is torn only where a line has no room for it; the way on is seen, and the code as
// a picture where there is room; who took pictures in the dark hears of it.
#include <gtest/gtest.h>

#include <array>

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

class LastPageTest : public testing::Test {
 protected:
  LastPageTest() {
    view.receipt = "4821-9037-5512-71";
    const ImageView code{pixels.data(), 4, 4, 12, PixelFormat::Rgb8};
    view.receipt_code = view.take_home.link_code = {code, 1};
    visit.step = Step::Thanks;
  }
  const Node* find(std::string_view id) { return ui->tree().find(id); }
  std::array<std::byte, 48> pixels{};
  std::unique_ptr<Ui> ui = test::make_screen();
  ViewState view;
  Visit visit;
};

TEST_F(LastPageTest, TwoCodesInLargeLettersLeaveTheWayOnInView) {
  view.take_home.link = "https://faces.example.org/heads/0d4a8f6c2b9e7a5310c8f4d6b2a09e17";
  ui->resize(1080, 1920);
  visit.text_size = kTextPercents.size() - 1;
  for (std::size_t i = 0; i < kLanguages; ++i) {
    visit.language = static_cast<Language>(i);
    ui->show(view, visit);
    const Node* done = find("finish");
    ASSERT_NE(done, nullptr);
    EXPECT_EQ(ui->tree().scroller_around(*done), nullptr) << info_of(visit.language).code;
    EXPECT_LE(done->rect.bottom(), 1920) << info_of(visit.language).code;
  }
}

// Who has just been thanked must not read that nothing was kept when the page turns to what is out of order.
TEST_F(LastPageTest, ThatNothingWasKeptIsSaidOnlyToWhomItHappened) {
  view.screen = Screen::Idle;
  visit.step = Step::Trouble;
  view.out_of_order = Trouble::Clock;
  ui->show(view, visit);
  EXPECT_EQ(find("kept"), nullptr);
  view.out_of_order = Trouble::None;
  view.trouble = Trouble::Camera;
  ui->show(view, visit);
  EXPECT_NE(find("kept"), nullptr);
}

TEST_F(LastPageTest, SomewhatLargerLettersLeaveTheCodesPicture) {
  visit.text_size = 1;
  for (const auto& [width, height] : {std::pair(1280, 800), std::pair(1024, 600), std::pair(1920, 1080)}) {
    ui->resize(width, height);
    for (std::size_t i = 0; i < kLanguages; ++i) {
      visit.language = static_cast<Language>(i);
      ui->show(view, visit);
      SCOPED_TRACE(std::string(info_of(visit.language).code) + " " + std::to_string(width));
      EXPECT_NE(find("qr"), nullptr);
      EXPECT_FALSE(find("message")->overflows()) << "all of it at one look";
    }
  }
}

TEST_F(LastPageTest, WhoTookPicturesInTheDarkIsToldWhyTheyFailed) {
  visit.step = Step::Trouble;
  view.screen = Screen::Idle;
  view.trouble = Trouble::Refused;
  ui->show(view, visit);
  EXPECT_EQ(find("why"), nullptr);
  visit.shot_in_the_dark = true;
  ui->show(view, visit);
  ASSERT_NE(find("why"), nullptr);
  EXPECT_EQ(find("why")->text, "It is too dark here for the cameras");
}

}  // namespace
}  // namespace relievo::ui
