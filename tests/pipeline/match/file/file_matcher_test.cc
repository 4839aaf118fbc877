// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/file_matcher.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/pipeline/match/match_truth.h"

namespace relievo::pipeline {
namespace {

using test::StageFixture;

class FileMatcherTest : public testing::Test {
 protected:
  Result<MatchSet> read(const std::string& text, std::size_t output_bytes = 1 << 22) {
    fixture_ = std::make_unique<StageFixture>(output_bytes, 1 << 22, 1);
    return match({"matches.txt", std::make_shared<const std::string>(text)}, *fixture_);
  }
  Result<MatchSet> match(TextFile file, StageFixture& fixture) {
    const Keypoints none(std::pmr::get_default_resource());
    return run_stage(fixture.context, [&](StageContext& c) {
      return FileMatcher({.file = std::move(file), .sigma_px = 0.4F}).match(pair_, none, c);
    });
  }
  std::string refusal(const std::string& text) {
    const auto matches = read(text);
    if (matches) return "accepted";
    EXPECT_EQ(matches.error().code, Errc::InvalidInput) << text;
    return std::string(matches.error().where());
  }

  test::BumpScene scene_{.width_px = 160, .height_px = 100};
  std::vector<std::byte> block_ = std::vector<std::byte>(std::size_t{2} << 20);
  Arena memory_{block_};
  RectifiedPair pair_ = scene_.render(&memory_);
  std::unique_ptr<StageFixture> fixture_;
};

TEST_F(FileMatcherTest, ReadsWhatAHandWrites) {
  const auto matches =
      read("# by hand\n80.5 50 21.25\n\n  90, 51.5,\t20 , 0.125  # an eye\r\n100\t52\t-3e-1");
  ASSERT_TRUE(matches);
  ASSERT_EQ(matches->matches.size(), 3U);
  EXPECT_EQ(matches->lattice_step_px, 0);
  EXPECT_EQ(matches->matches[0].left_px.x, 80.5F);
  EXPECT_EQ(matches->matches[0].disparity_px, 21.25F);
  EXPECT_EQ(matches->matches[0].sigma_px, 0.4F);
  EXPECT_EQ(matches->matches[1].left_px.y, 51.5F);
  EXPECT_EQ(matches->matches[1].sigma_px, 0.125F);
  EXPECT_EQ(matches->matches[2].disparity_px, -0.3F);
}

TEST_F(FileMatcherTest, SaysHowAlikeTheTwoPlacesAre) {
  const std::string right = std::to_string(scene_.disparity(90, 50));
  const auto matches = read("90 50 " + right + "\n90 50 0\n");
  ASSERT_TRUE(matches);
  EXPECT_LT(matches->matches[0].cost, 0.05F);
  EXPECT_GT(matches->matches[1].cost, 0.4F);
}

TEST_F(FileMatcherTest, HostileFilesAreRefusedByTheirLine) {
  for (const char* line : {"80",           "80 50",
                           "80 50 20 1 1", "80 50 x",
                           "80 50 20x",    "80 50 nan",
                           "80 50 inf",    "80 50 1e999",
                           "80,,50 20",    "80 50 20,",
                           ",80 50 20",    "80 50 0x14",
                           "-1 50 20",     "160 50 20",
                           "80 100 20",    "80 50 90",
                           "80 50 -90",    "80 50 20 0",
                           "80 50 20 -1",  "80 50 20 1e9",
                           "\x01\x02",     "eighty fifty twenty"}) {
    const std::string place = refusal(std::string("# one\n80 50 20\n") + line + "\n80 50 20\n");
    EXPECT_NE(place.find("matches.txt, line 3"), std::string::npos) << line << " -> " << place;
  }
  EXPECT_NE(refusal(std::string("80 50 20\n80 50\0 20\n", 18)).find("line 2"), std::string::npos);
  EXPECT_NE(refusal(std::string(100000, '7')).find("line 1"), std::string::npos);
}

TEST_F(FileMatcherTest, WhatHoldsNoMatchSaysSo) {
  StageFixture fixture(1 << 22, 1 << 22, 1);
  EXPECT_EQ(match({}, fixture).error().where(), "file-matches.path");
  EXPECT_EQ(match({"gone.txt"}, fixture).error().code, Errc::NotFound);
  EXPECT_EQ(match({"gone.txt"}, fixture).error().where(), "gone.txt");
  EXPECT_EQ(read("").error().code, Errc::TooFewMatches);
  EXPECT_EQ(read("# nothing\n\n").error().code, Errc::TooFewMatches);
}

TEST_F(FileMatcherTest, AMatchAtEveryPixelIsRead) {
  std::string text = "x y disparity\n";
  for (int k = 0; k < 200'000; ++k)
    text += std::to_string(40 + k % 100) + "." + std::to_string(k % 1000) + " " + std::to_string(k % 99) +
            " 20.125\n";
  const auto matches = read(text, std::size_t{16} << 20);
  ASSERT_TRUE(matches);
  EXPECT_EQ(matches->matches.size(), 200'000U);
}

TEST_F(FileMatcherTest, MemoryThatIsUsedUpAndCancellationAreReported) {
  std::string many;
  for (int k = 0; k < 2000; ++k) many += "80 50 20\n";
  EXPECT_EQ(read(many, 1024).error().code, Errc::OutOfMemory);
  StageFixture roomy(1 << 20, 1 << 20, 1);
  roomy.cancelled = true;
  const auto matches = match({"matches.txt", std::make_shared<const std::string>(many)}, roomy);
  ASSERT_FALSE(matches);
  EXPECT_EQ(matches.error().code, Errc::Cancelled);
}

}  // namespace
}  // namespace relievo::pipeline
