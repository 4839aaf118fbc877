// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include "pipeline/match/file/match_text.h"
#include "tests/pipeline/match/select/selection_fixture.h"

namespace relievo::pipeline {
namespace {

using test::SelectionFixture;

class FilePoints : public testing::Test {
 protected:
  Result<Keypoints> read(const std::string& text) {
    test::write_text(here_ / "points.csv", text);
    return choose((here_ / "points.csv").string());
  }
  Result<Keypoints> choose(const std::string& path) {
    return fixture_.select(test::make_selector("file-points", {{"file-points.path", path}}),
                           SelectionFixture::rendered());
  }
  void refused(const std::string& text, const std::string& place) {
    const auto chosen = read(text);
    ASSERT_FALSE(chosen) << text;
    EXPECT_EQ(chosen.error().code, Errc::InvalidInput) << text;
    const std::string where(chosen.error().where());
    EXPECT_EQ(where.substr(where.size() - std::min(where.size(), place.size())), place) << text;
  }
  test::TemporaryFolder here_;
  SelectionFixture fixture_;  // 200 x 160
};

TEST_F(FilePoints, EveryFormIsRead) {
  const auto chosen = read(
      "# by hand\r\nx,y\n\n10.25,20.5\r\n 30 40\n12;7 ; left eye, the corner\n\t+1e1\t8\n10.25, 20.5\n0,0\n199,159");
  ASSERT_TRUE(chosen);
  const Vec2f expected[] = {{0, 0}, {12, 7}, {10, 8}, {10.25F, 20.5F}, {30, 40}, {199, 159}};
  ASSERT_EQ(chosen->points.size(), std::size(expected));
  for (std::size_t k = 0; k < std::size(expected); ++k) {
    EXPECT_EQ(chosen->points[k].at_px.x, expected[k].x);
    EXPECT_EQ(chosen->points[k].at_px.y, expected[k].y);
  }
  EXPECT_EQ(chosen->lattice_step_px, 0);
}

TEST_F(FilePoints, HostileLinesAreNamed) {
  refused("1,2\n3,4\nfive,6\n", "points.csv, line 3");
  refused("1,2\n3\n", "points.csv, line 2");
  refused("1,2\n3,\n", "points.csv, line 2");
  refused("1,,2\n", "points.csv, line 1");
  refused("1 2\nnan,4\n", "points.csv, line 2");
  refused("1 2\n3,inf\n", "points.csv, line 2");
  refused("1 2\n3,1e999\n", "points.csv, line 2");
  refused("1 2\n3,4abc\n", "points.csv, line 2");
  refused("1 2\nx,y\n", "points.csv, line 2");  // a title belongs on top
  refused("1 2\n--3,4\n", "points.csv, line 2");
  refused("1 2\n-1,4\n", "points.csv, line 2");
  refused("1 2\n200,4\n", "points.csv, line 2");
  refused("1 2\n4,159.5\n", "points.csv, line 2");
  refused(std::string("1 2\n\0 3\n", 8), "points.csv, line 2");
  refused("1 2\n\xff\xfe\x00\n", "points.csv, line 2");
  refused("", "points.csv");
  refused("# nothing\n\n", "points.csv");
  refused("x,y\n", "points.csv");
}

TEST_F(FilePoints, OnePointOrMoreThanThePictureHasPixels) {
  const auto one = read("7,8");
  ASSERT_TRUE(one);
  EXPECT_EQ(one->points.size(), 1U);
  std::string text;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 400; ++x)
      text += std::to_string(x / 2) + (x % 2 != 0 && x < 398 ? ".5" : "") + " " + std::to_string(y) + "\n";
  const auto many = read(text);
  ASSERT_TRUE(many) << many.error().what.view();
  EXPECT_EQ(many->points.size(), 399U * 160U);  // the last column stands there twice
}

TEST_F(FilePoints, WhatWasNotReadIsNamed) {
  EXPECT_EQ(choose("").error().where(), "file-points.path");
  AlgorithmSet set;
  ASSERT_TRUE(set.set("selector", "file-points") && set.set("file-points.path", "gone.csv"));
  const auto made = make_algorithms(set);
  ASSERT_TRUE(made);
  const auto chosen = fixture_.select(made->selector, SelectionFixture::rendered());
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, Errc::NotFound);
  EXPECT_EQ(chosen.error().where(), "gone.csv");
}

// As spreadsheets write them.
TEST(NumberLines, BeginAfterAByteOrderMark) {
  NumberLine line;
  NumberLines titled("\xEF\xBB\xBFx,y\n1,2\n", 4), plain(
                                                       "\xEF\xBB\xBF"
                                                       "1,2\n",
                                                       4);
  ASSERT_TRUE(titled.next(line));
  EXPECT_EQ(line.number, 2U) << "the first has titles";
  ASSERT_TRUE(plain.next(line));
  EXPECT_EQ(line.count, 2U);
  EXPECT_EQ(line.value[0], 1);
}

TEST(NumberLines, SaysWhatIsLeftOfALine) {
  NumberLines lines("x,y\n\n1 2 left # eye\n3;+4.5,\n5,,6\n7 8x\n", 4);
  const struct {
    std::uint32_t number;
    std::vector<double> values;
    std::string_view rest;
  } expected[] = {{3, {1, 2}, "left"}, {4, {3, 4.5}, ","}, {5, {5}, ",,6"}, {6, {7}, "8x"}};
  NumberLine line;
  for (const auto& e : expected) {
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(line.number, e.number);
    EXPECT_EQ(std::vector<double>(line.value.begin(), line.value.begin() + line.count), e.values);
    EXPECT_EQ(line.rest, e.rest);
  }
  EXPECT_FALSE(lines.next(line));
}

}  // namespace
}  // namespace relievo::pipeline
