// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The printed page, judged as a printer and a camera would: rendered, and its board found and measured.
#include "firmware/calibrate/calibrate_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "hal/base/whole_file.h"
#include "hal/picture_file.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

using firmware::PageFormat;
using firmware::PatternPage;
using pipeline::BoardKind;
using pipeline::BoardPattern;

constexpr int kDotsAnInch = 150;
constexpr double kPixelMm = 25.4 / kDotsAnInch;

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(PrintPattern, TheSmallestPaperThatHoldsBoardAndMargin) {
  struct Row {
    BoardPattern pattern;
    const char* paper;
    bool upright;
  };
  for (const Row& row :
       {Row{{10, 7, 20}, "A4", false}, Row{{7, 10, 20}, "A4", true}, Row{{10, 7, 21}, "A3", false},
        Row{{9, 9, 15}, "A4", false}, Row{{20, 15, 20}, "A2", false}, Row{{20, 15, 30}, "A1", false},
        Row{{10, 14, 60}, "A0", true}, Row{{5, 4, 3, BoardKind::Charuco}, "A4", false}}) {
    const auto page = firmware::lay_out_pattern(row.pattern);
    ASSERT_TRUE(page) << row.pattern.columns << "x" << row.pattern.rows;
    EXPECT_EQ(std::string(page->paper), row.paper) << row.pattern.columns << "x" << row.pattern.rows;
    EXPECT_EQ(page->height_mm > page->width_mm, row.upright)
        << row.pattern.columns << "x" << row.pattern.rows;
    const double square = row.pattern.square_mm;
    EXPECT_GE(page->board_x_mm, square);
    EXPECT_GE(page->board_y_mm, square);
    EXPECT_GE(page->width_mm - page->board_x_mm - (row.pattern.columns + 1) * square, square - 1e-9);
    // Nothing of the footer in the white margin below.
    EXPECT_LE(page->board_y_mm + (row.pattern.rows + 2) * square, page->ruler_y_mm - 2.4);
    EXPECT_LT(page->ruler_x_mm + page->ruler_mm, page->text_x_mm);
    EXPECT_GT(page->text_width_mm, 60);
  }
}

template <typename T>
Errc error_of(const Result<T>& result) {
  EXPECT_FALSE(result);
  return result ? Errc::InvalidState : result.error().code;
}

TEST(PrintPattern, WhatNoPaperHoldsIsRefused) {
  EXPECT_EQ(error_of(firmware::lay_out_pattern({40, 15, 40})), Errc::InvalidInput);
  EXPECT_EQ(error_of(firmware::lay_out_pattern({10, 7, 1000})), Errc::InvalidInput);
  EXPECT_EQ(error_of(firmware::lay_out_pattern({2, 7, 20})), Errc::InvalidInput);
  EXPECT_EQ(error_of(firmware::lay_out_pattern({60, 60, 5, BoardKind::Charuco})), Errc::InvalidInput)
      << "too many markers";
}

TEST(PrintPattern, TheEndingChoosesTheFormat) {
  EXPECT_EQ(*firmware::page_format("board.pdf"), PageFormat::Pdf);
  EXPECT_EQ(*firmware::page_format("my.board.SVG"), PageFormat::Svg);
  for (const char* name : {"board", "board.png", "pdf", ".", ""})
    EXPECT_EQ(error_of(firmware::page_format(name)), Errc::InvalidInput) << name;
}

TEST(PrintPattern, ThePageSaysWhatItIs) {
  const auto page = firmware::lay_out_pattern({10, 7, 20, BoardKind::Charuco, 15, 5});
  ASSERT_TRUE(page);
  const std::string words = page->text.front() + "\n" + page->text.back();
  for (const char* word :
       {"ChArUco", "15 mm", "DICT_5X5_1000", "10x7 inner corners", "20 mm", "Print at 100 %", "100 mm",
        "220 x 160 mm", "--pattern charuco --corners 10x7 --square-mm 20 --marker-mm 15 --marker-bits 5"})
    EXPECT_NE(words.find(word), std::string::npos) << word;
}

class RenderedPage : public ::testing::TestWithParam<BoardPattern> {
 protected:
  // As a printer would put it on paper.
  bool render(const PatternPage& page) {
    const auto pdf = firmware::draw_page(page, GetParam(), PageFormat::Pdf);
    EXPECT_TRUE(pdf);
    if (!pdf || !write_whole_file(folder_ / "page.pdf", *pdf)) return false;
    const Said said = run_program({"/usr/bin/pdftoppm", "-r", std::to_string(kDotsAnInch), "-gray", "-png",
                                   "-singlefile", "page.pdf", "page"},
                                  folder_.path());
    auto picture = hal::read_picture(folder_ / "page.png");
    EXPECT_TRUE(picture) << said.err;
    if (picture) picture_ = *std::move(picture);
    return static_cast<bool>(picture);
  }
  int grey(double x_mm, double y_mm) const {
    const ImageView view = picture_.view();
    const int bytes = bytes_per_pixel(view.format);
    return view.row(static_cast<int>(y_mm / kPixelMm))[static_cast<int>(x_mm / kPixelMm) * bytes];
  }

  TemporaryFolder folder_;
  hal::Picture picture_;
};

TEST_P(RenderedPage, HasTheBoardAtTrueSize) {
  if (!std::filesystem::exists("/usr/bin/pdftoppm")) GTEST_SKIP() << "poppler-utils is not installed";
  const BoardPattern& pattern = GetParam();
  const auto page = firmware::lay_out_pattern(pattern);
  ASSERT_TRUE(page && render(*page));
  EXPECT_NEAR(picture_.width_px * kPixelMm, page->width_mm, 0.2);
  const auto found = pipeline::find_board(picture_.view(), pattern);
  ASSERT_TRUE(found) << found.error().what.view();
  const auto& first = found->front();
  const auto& last = found->back();
  const double across = (last.x - first.x) * kPixelMm / (pattern.columns - 1);
  const double down = (last.y - first.y) * kPixelMm / (pattern.rows - 1);
  EXPECT_NEAR(across / pattern.square_mm, 1, 1e-3);
  EXPECT_NEAR(down / pattern.square_mm, 1, 1e-3);
  // Pixel (0, 0) covers the first pixel's breadth of the paper.
  EXPECT_NEAR((first.x + 0.5) * kPixelMm, page->board_x_mm + pattern.square_mm, 0.05);
  EXPECT_NEAR((first.y + 0.5) * kPixelMm, page->board_y_mm + pattern.square_mm, 0.05);
}

TEST_P(RenderedPage, HasARulerOfTrueLengthAndAWhiteMargin) {
  if (!std::filesystem::exists("/usr/bin/pdftoppm")) GTEST_SKIP() << "poppler-utils is not installed";
  const BoardPattern& pattern = GetParam();
  const auto page = firmware::lay_out_pattern(pattern);
  ASSERT_TRUE(page && render(*page));
  // The tall ticks at both ends and every centimetre, and white between their tops.
  for (int mm = 0; mm <= 100; mm += 10) {
    int darkest = 255;
    for (double d = -0.2; d <= 0.2; d += 0.05)
      darkest = std::min(darkest, grey(page->ruler_x_mm + mm + d, page->ruler_y_mm - 2.1));
    EXPECT_LT(darkest, 200) << mm;
    EXPECT_EQ(grey(page->ruler_x_mm + mm - 1, page->ruler_y_mm - 2.1), 255) << mm;
  }
  const double width = (pattern.columns + 1) * pattern.square_mm;
  const double height = (pattern.rows + 1) * pattern.square_mm;
  for (double t = -pattern.square_mm + 0.3; t < width + pattern.square_mm - 0.3; t += 0.5) {
    EXPECT_EQ(grey(page->board_x_mm + t, page->board_y_mm - pattern.square_mm / 2), 255);
    EXPECT_EQ(grey(page->board_x_mm + t, page->board_y_mm + height + pattern.square_mm - 0.3), 255);
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, RenderedPage,
                         ::testing::Values(BoardPattern{10, 7, 20},
                                           BoardPattern{10, 7, 20, BoardKind::Charuco},
                                           BoardPattern{9, 12, 12.5, BoardKind::Charuco, 9, 6}));

TEST(PrintPattern, TheSvgHasTheSameMillimetres) {
  const BoardPattern pattern{10, 7, 20};
  const auto page = firmware::lay_out_pattern(pattern);
  ASSERT_TRUE(page);
  const auto svg = firmware::draw_page(*page, pattern, PageFormat::Svg);
  ASSERT_TRUE(svg);
  const std::string text = text_of(*svg);
  EXPECT_NE(text.find("width=\"841.88"), std::string::npos) << "297 mm in points";
  // Every number pair of the path with the most closed shapes, which is the board's.
  std::string path;
  for (std::size_t at = text.find(" d=\""); at != std::string::npos; at = text.find(" d=\"", at + 1)) {
    const std::string one = text.substr(at + 4, text.find('"', at + 4) - at - 4);
    if (std::count(one.begin(), one.end(), 'Z') > std::count(path.begin(), path.end(), 'Z')) path = one;
  }
  std::istringstream words(path);
  std::string word;
  std::vector<double> numbers;
  while (words >> word)
    if (word.find_first_not_of("0123456789.-") == std::string::npos)
      numbers.push_back(std::stod(word) * 25.4 / 72);
  ASSERT_GT(numbers.size(), 8U * 44);
  double left = 1e9, right = 0;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    left = std::min(left, numbers[i]), right = std::max(right, numbers[i]);
  EXPECT_NEAR(right - left, 220, 0.01);
}

}  // namespace
}  // namespace relievo::test
