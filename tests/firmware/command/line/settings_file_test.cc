// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/algorithm_choice.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using Words = std::vector<std::string>;

TEST(SettingsFile, GivesTheWordsOfTheCommandLine) {
  const auto words = parse_settings(
      "[matcher]\nname = \"zmncc\"\n[zmncc]\nwindow_px = 15\nlimit = 0.25\ncolour = true\n", "a.toml");
  ASSERT_TRUE(words);
  EXPECT_EQ(*words, (Words{"matcher=zmncc", "zmncc.colour=true", "zmncc.limit=0.25", "zmncc.window_px=15"}));
}

TEST(SettingsFile, NamesTheLineThatIsWrong) {
  for (const char* text : {"[a]\nx = \n", "x = 1\n", "[a]\nx = [1, 2]\n", "[a]\n[a.b]\nx = 1\n"}) {
    const auto words = parse_settings(text, "a.toml");
    ASSERT_FALSE(words) << text;
    EXPECT_EQ(words.error().code, Errc::InvalidInput);
    EXPECT_EQ(words.error().where().substr(0, 7), "a.toml:") << text;
  }
}

TEST(SettingsFile, EmptyIsNoSettingAndAbsentIsAnError) {
  const auto none = parse_settings("", "a.toml");
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
  const test::TemporaryFolder here;
  EXPECT_EQ(choose_algorithms({.file = here / "no.toml", .settings = {}}).error().code, Errc::NotFound);
}

}  // namespace
}  // namespace relievo::firmware
