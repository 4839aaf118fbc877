// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/bench/calibration/board_peers.h"

namespace relievo::bench {
namespace {

cv::Mat grey_of(const ImageView& picture) {
  return cv::Mat(picture.height_px, picture.width_px, CV_8UC1, const_cast<std::byte*>(picture.bytes),
                 static_cast<std::size_t>(picture.stride_bytes));
}

pipeline::BoardCorners corners_of(const std::vector<cv::Point2f>& found) {
  pipeline::BoardCorners corners;
  for (const cv::Point2f& p : found) corners.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  return corners;
}

}  // namespace

pipeline::BoardCorners sector_based_board(const ImageView& picture, const pipeline::BoardPattern& pattern) {
  std::vector<cv::Point2f> found;
  if (!cv::findChessboardCornersSB(
          grey_of(picture), {pattern.columns, pattern.rows}, found,
          cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY))
    return {};
  return corners_of(found);
}

pipeline::BoardCorners classic_board(const ImageView& picture, const pipeline::BoardPattern& pattern) {
  std::vector<cv::Point2f> found;
  const cv::Mat grey = grey_of(picture);
  if (!cv::findChessboardCorners(grey, {pattern.columns, pattern.rows}, found,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return {};
  cv::cornerSubPix(grey, found, {5, 5}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4});
  return corners_of(found);
}

pipeline::BoardCorners aruco_board(const ImageView& picture, const pipeline::BoardPattern& pattern) {
  const int names[] = {cv::aruco::DICT_4X4_1000, cv::aruco::DICT_5X5_1000, cv::aruco::DICT_6X6_1000,
                       cv::aruco::DICT_7X7_1000};
  const auto dictionary = cv::aruco::getPredefinedDictionary(names[pattern.marker_bits - 4]);
  const auto board = cv::aruco::CharucoBoard::create(
      pattern.columns + 1, pattern.rows + 1, static_cast<float>(pattern.square_mm),
      static_cast<float>(pattern.marker_side_mm()), dictionary);
  const cv::Mat grey = grey_of(picture);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids;
  cv::aruco::detectMarkers(grey, dictionary, markers, marker_ids);
  if (marker_ids.empty()) return {};
  std::vector<cv::Point2f> found;
  std::vector<int> ids;
  cv::aruco::interpolateCornersCharuco(markers, marker_ids, grey, board, found, ids);
  if (found.empty()) return {};
  pipeline::BoardCorners corners(static_cast<std::size_t>(pattern.corners()), {std::nan(""), std::nan("")});
  for (std::size_t i = 0; i < found.size(); ++i)
    corners[static_cast<std::size_t>(ids[i])] = {static_cast<double>(found[i].x),
                                                 static_cast<double>(found[i].y)};
  return corners;
}

}  // namespace relievo::bench
