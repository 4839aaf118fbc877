// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of calibrate --live.
#include <vector>

#include <gtest/gtest.h>

#include "firmware/arguments/command_line.h"

namespace relievo::tests {
namespace {

using firmware::CalibrateLiveArgs;

firmware::CommandLine parse(std::vector<const char*> words) {
  words.insert(words.begin(), {"relievo", "calibrate"});
  return firmware::parse_command_line(static_cast<int>(words.size()), words.data());
}

TEST(CalibrateLiveWords, AreUnderstood) {
  const auto line =
      parse({"--live", "--board", "sim", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml",
             "--goal-mm", "0.05", "--seed", "7", "--baseline-mm", "137", "--store", "s"});
  const auto* args = std::get_if<CalibrateLiveArgs>(&line.command);
  ASSERT_NE(args, nullptr);
  EXPECT_EQ(args->cameras, "sim");
  EXPECT_EQ(args->board.corners_across, 10);
  EXPECT_EQ(args->board.corners_down, 7);
  EXPECT_EQ(args->board.square_mm, 20);
  EXPECT_EQ(args->goal_mm, 0.05);
  EXPECT_EQ(args->seed, 7U);
  EXPECT_EQ(args->baseline_mm, 137);
  EXPECT_EQ(args->output, "rig.yml");
  EXPECT_EQ(args->store, "s");
}

TEST(CalibrateLiveWords, ThatContradictEachOtherAreRefused) {
  const std::vector<std::vector<const char*>> wrong = {
      {"--live", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml"},  // no cameras
      {"--live", "DIR", "--board", "sim", "--corners", "10x7", "--square-mm", "20", "-o",
       "rig.yml"},  // and a folder
      {"DIR", "--board", "sim", "--corners", "10x7", "--square-mm", "20", "-o",
       "rig.yml"},  // cameras for a folder
      {"DIR", "--goal-mm", "0.1", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml"},
      {"--live", "--board", "sim", "--goal-mm", "0", "--corners", "10x7", "--square-mm", "20", "-o",
       "rig.yml"},
      {"--live", "--board", "sim", "--report", "R", "--corners", "10x7", "--square-mm", "20", "-o",
       "rig.yml"},
  };
  for (const auto& words : wrong) EXPECT_EQ(parse(words).exit_code, 2) << words[0] << ' ' << words[1];
}

}  // namespace
}  // namespace relievo::tests
