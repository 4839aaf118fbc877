// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/bench/calibration/rig_peer.h"

namespace relievo::bench {
namespace {

pipeline::CameraIntrinsics camera_of(const cv::Mat& k, const cv::Mat& d, int width, int height) {
  pipeline::CameraIntrinsics c;
  c.focal_px = {k.at<double>(0, 0), k.at<double>(1, 1)};
  c.centre_px = {k.at<double>(0, 2), k.at<double>(1, 2)};
  for (int i = 0; i < 5; ++i) c.distortion[i] = d.at<double>(i);
  c.width_px = width;
  c.height_px = height;
  return c;
}

std::vector<cv::Point2f> points_of(const pipeline::BoardCorners& corners) {
  std::vector<cv::Point2f> points;
  for (const pipeline::Vec2d& at : corners)
    points.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
  return points;
}

}  // namespace

pipeline::BoardCorners peer_corners(const ImageView& picture, const pipeline::BoardPattern& pattern) {
  const bool grey = picture.format == PixelFormat::Grey8;
  const cv::Mat view(picture.height_px, picture.width_px, grey ? CV_8UC1 : CV_8UC3,
                     const_cast<std::byte*>(picture.bytes), static_cast<std::size_t>(picture.stride_bytes));
  cv::Mat plain;
  if (grey) plain = view;
  else cv::cvtColor(view, plain, cv::COLOR_RGB2GRAY);
  std::vector<cv::Point2f> found;
  if (!cv::findChessboardCornersSB(plain, {pattern.columns, pattern.rows}, found,
                                   cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY))
    return {};
  pipeline::BoardCorners corners;
  for (const cv::Point2f& at : found)
    corners.push_back({static_cast<double>(at.x), static_cast<double>(at.y)});
  return corners;
}

std::optional<pipeline::StereoCalibration> peer_calibration(const PeerViews& views, bool refine) {
  std::vector<cv::Point3f> board;
  for (int i = 0; i < views.pattern.corners(); ++i)
    board.emplace_back(static_cast<float>((i % views.pattern.columns) * views.pattern.square_mm),
                       static_cast<float>((i / views.pattern.columns) * views.pattern.square_mm), 0.0F);
  std::vector<std::vector<cv::Point3f>> boards;
  std::vector<std::vector<cv::Point2f>> left, right;
  for (std::size_t v = 0; v < views.left.size(); ++v) {
    if (views.left[v].empty() || views.right[v].empty()) continue;
    boards.push_back(board);
    left.push_back(points_of(views.left[v]));
    right.push_back(points_of(views.right[v]));
  }
  if (boards.size() < 3) return std::nullopt;
  const cv::Size size(views.width_px, views.height_px);
  cv::Mat k1, d1, k2, d2, r, t, e, f;
  try {
    std::vector<cv::Mat> turns, shifts;
    cv::calibrateCamera(boards, left, size, k1, d1, turns, shifts);
    cv::calibrateCamera(boards, right, size, k2, d2, turns, shifts);
    cv::stereoCalibrate(boards, left, right, k1, d1, k2, d2, size, r, t, e, f,
                        refine ? cv::CALIB_USE_INTRINSIC_GUESS : cv::CALIB_FIX_INTRINSIC,
                        cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-7));
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  pipeline::StereoCalibration rig;
  rig.left = camera_of(k1, d1, views.width_px, views.height_px);
  rig.right = camera_of(k2, d2, views.width_px, views.height_px);
  for (int i = 0; i < 9; ++i) rig.right_from_left.rotation.m[i] = r.at<double>(i / 3, i % 3);
  rig.right_from_left.translation_mm = {t.at<double>(0), t.at<double>(1), t.at<double>(2)};
  return rig;
}

}  // namespace relievo::bench
