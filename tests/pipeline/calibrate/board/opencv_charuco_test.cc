// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boards as OpenCV draws them are boards as we read them: same markers, same order of the corners; and
// what we draw for the printer is the same picture.
#include <cmath>
#include <opencv2/aruco/charuco.hpp>

#include <gtest/gtest.h>

#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::tests {
namespace {

constexpr int kSquarePx = 60;

cv::Mat opencvs_board(const pipeline::BoardPattern& b) {
  const int names[] = {cv::aruco::DICT_4X4_1000, cv::aruco::DICT_5X5_1000, cv::aruco::DICT_6X6_1000,
                       cv::aruco::DICT_7X7_1000};
  const auto board = cv::aruco::CharucoBoard::create(
      b.columns + 1, b.rows + 1, static_cast<float>(b.square_mm), static_cast<float>(b.marker_side_mm()),
      cv::aruco::getPredefinedDictionary(names[b.marker_bits - 4]));
  cv::Mat picture;
  board->draw({(b.columns + 3) * kSquarePx, (b.rows + 3) * kSquarePx}, picture, kSquarePx, 1);
  return picture;
}

class OpenCvsBoards : public ::testing::TestWithParam<pipeline::BoardPattern> {};

TEST_P(OpenCvsBoards, AreReadAndDrawnAlike) {
  const pipeline::BoardPattern& b = GetParam();
  const cv::Mat picture = opencvs_board(b);
  const auto found = pipeline::find_board({reinterpret_cast<const std::byte*>(picture.data), picture.cols,
                                           picture.rows, static_cast<int>(picture.step), PixelFormat::Grey8},
                                          b);
  ASSERT_TRUE(found);
  // Edges lie between two pixels there.
  for (int i = 0; i < b.corners(); ++i) {
    const auto& at = (*found)[static_cast<std::size_t>(i)];
    ASSERT_TRUE(pipeline::seen(at)) << i;
    EXPECT_NEAR(at.x, (i % b.columns + 2) * kSquarePx - 0.5, 0.1) << i;
    EXPECT_NEAR(at.y, (i / b.columns + 2) * kSquarePx - 0.5, 0.1) << i;
  }
  const auto black = pipeline::draw_board(b);
  ASSERT_TRUE(black);
  cv::Mat drawn(picture.size(), CV_8UC1, cv::Scalar(255));
  const double scale = kSquarePx / b.square_mm;
  for (const auto& area : *black) {
    const int left = static_cast<int>(std::lround(area.x_mm * scale)) + kSquarePx;
    const int top = static_cast<int>(std::lround(area.y_mm * scale)) + kSquarePx;
    const int right = static_cast<int>(std::lround((area.x_mm + area.width_mm) * scale)) + kSquarePx;
    const int bottom = static_cast<int>(std::lround((area.y_mm + area.height_mm) * scale)) + kSquarePx;
    drawn(cv::Rect(left, top, right - left, bottom - top)).setTo(0);
  }
  cv::Mat differs = drawn != picture;
  EXPECT_EQ(cv::countNonZero(differs), 0);
}

pipeline::BoardPattern charuco(int columns, int rows, int bits) {
  // Modules and rims of whole pixels: no rounding to disagree about.
  const double marker_mm = 20.0 * (bits + 2) * (11 - bits) / kSquarePx;
  return {columns, rows, 20, pipeline::BoardKind::Charuco, marker_mm, bits};
}

INSTANTIATE_TEST_SUITE_P(Sizes, OpenCvsBoards,
                         ::testing::Values(charuco(10, 7, 4), charuco(7, 10, 4), charuco(5, 5, 5),
                                           charuco(8, 6, 6), charuco(4, 3, 7)));

}  // namespace
}  // namespace relievo::tests
