// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of a script, and what is said of wrong ones. That a script moves a kiosk is kiosk_test's.
#include "firmware/kiosk/script/script_player.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using Kind = ScriptAction::Kind;

TEST(Script, EveryWordIsRead) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "visit.script";
  std::ofstream(file)
      << "# a remark\n\nwait Review 12.5\r\n  tap key A\nhold staff 3\ndrag face -40 8\ntype Ada Lovelace  \npause 0.5\nscreenshot end\nplug /media/a stick\nunplug\n";
  const auto script = read_script(file);
  ASSERT_TRUE(script.has_value()) << script.error().where();
  const Kind kinds[] = {Kind::Wait,  Kind::Tap,        Kind::Hold, Kind::Drag,  Kind::Type,
                        Kind::Pause, Kind::Screenshot, Kind::Plug, Kind::Unplug};
  ASSERT_EQ(script->size(), std::size(kinds));
  for (std::size_t i = 0; i < script->size(); ++i) EXPECT_EQ((*script)[i].kind, kinds[i]) << i;
  EXPECT_EQ((*script)[0].seconds, 12.5);
  EXPECT_EQ((*script)[1].word, "key A");
  EXPECT_EQ((*script)[3].dx_px, -40);
  EXPECT_EQ((*script)[4].word, "Ada Lovelace");
  EXPECT_EQ((*script)[7].word, "/media/a stick");
  EXPECT_NE((*script)[8].where.find(":11"), std::string::npos);
}

TEST(Script, AnIdMayHaveBlanksInIt) {
  const auto drag = read_script_line("drag  kept picture 1\t-40  8 ", "a:1");
  ASSERT_TRUE(drag && *drag);
  EXPECT_EQ((*drag)->word, "kept picture 1");
  EXPECT_EQ((*drag)->dx_px, -40);
  EXPECT_EQ((*drag)->dy_px, 8);
  const auto hold = read_script_line("hold record 2 3.5", "a:1");
  ASSERT_TRUE(hold && *hold);
  EXPECT_EQ((*hold)->word, "record 2");
  EXPECT_EQ((*hold)->seconds, 3.5);
}

TEST(Script, WrongWordsAreToldWithTheirLine) {
  for (const char* bad : {"jump", "wait", "wait review soon", "wait review -1", "tap", "hold staff", "hold 3",
                          "drag face 1", "drag face 1 x", "drag 1 2", "drag", "type", "pause nan",
                          "pause 1 2", "screenshot ../x", "screenshot .hidden", "plug", "unplug now"}) {
    const auto read = read_script_line(bad, "a:1");
    ASSERT_FALSE(read.has_value()) << bad;
    EXPECT_EQ(read.error().code, Errc::InvalidInput);
    EXPECT_EQ(read.error().where(), "a:1");
  }
  EXPECT_FALSE(read_script_line("tap " + std::string(300, 'x'), "a:1").has_value());
  EXPECT_FALSE(read_script("/nowhere/visit.script").has_value());
  EXPECT_FALSE(read_script("/dev/zero").has_value());  // has no end
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "empty") << "# nothing\n";
  EXPECT_FALSE(read_script(folder.path() / "empty").has_value());
}

}  // namespace
}  // namespace relievo::firmware
