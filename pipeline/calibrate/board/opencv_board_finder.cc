// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::pipeline {
namespace {

using Points = std::vector<cv::Point2f>;

// The refinement's window reaches this share of the way to the next corner: as wide as may be (its
// error falls with its area), but clear of the neighbours' edges.
constexpr double kWindowShare = 0.4;
constexpr int kMinWindowPx = 2;
constexpr int kMaxWindowPx = 40;
// Blur before the refinement, a share of the window: its gradients are differences of neighbours,
// which a sharp edge undersamples; blurred, its error falls to less than half (README).
constexpr double kSmoothingShare = 0.1;
constexpr double kMinSmoothingPx = 0.7;
constexpr double kMaxSmoothingPx = 2;
constexpr int kMinSidePx = 32;

cv::Mat grey_picture(const ImageView& picture) {
  auto* bytes = const_cast<std::byte*>(picture.bytes);  // cv::Mat has no read-only form; nothing writes
  const auto stride = static_cast<std::size_t>(picture.stride_bytes);
  cv::Mat grey;
  if (picture.format == PixelFormat::Grey8)
    return cv::Mat(picture.height_px, picture.width_px, CV_8UC1, bytes, stride);
  if (picture.format == PixelFormat::Rgb8) {
    cv::cvtColor(cv::Mat(picture.height_px, picture.width_px, CV_8UC3, bytes, stride), grey,
                 cv::COLOR_RGB2GRAY);
    return grey;
  }
  cv::normalize(cv::Mat(picture.height_px, picture.width_px, CV_16UC1, bytes, stride), grey, 0, 255,
                cv::NORM_MINMAX, CV_8U);
  return grey;
}

double shortest_step(const Points& corners, const BoardPattern& pattern) {
  double shortest = 1e9;
  for (int r = 0; r < pattern.rows; ++r)
    for (int c = 0; c < pattern.columns; ++c) {
      const auto at = static_cast<std::size_t>(r * pattern.columns + c);
      if (c + 1 < pattern.columns) shortest = std::min(shortest, cv::norm(corners[at] - corners[at + 1]));
      if (r + 1 < pattern.rows)
        shortest = std::min(shortest,
                            cv::norm(corners[at] - corners[at + static_cast<std::size_t>(pattern.columns)]));
    }
  return shortest;
}

void refine(const cv::Mat& grey, const BoardPattern& pattern, Points& corners) {
  const int half = std::clamp(static_cast<int>(kWindowShare * shortest_step(corners, pattern)), kMinWindowPx,
                              kMaxWindowPx);
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, cv::Size(),
                   std::clamp(kSmoothingShare * half, kMinSmoothingPx, kMaxSmoothingPx));
  cv::cornerSubPix(smooth, corners, cv::Size(half, half), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4));
}

// The classic finder first: with its corners refined it is the more accurate (measured: README) and
// the faster. The sector-based one (Duda and Frese 2018) sees boards in poor light and blur.
bool find(const cv::Mat& grey, const BoardPattern& pattern, Points& corners) {
  const cv::Size size(pattern.columns, pattern.rows);
  if (cv::findChessboardCorners(grey, size, corners,
                                cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return true;
  corners.clear();
  return cv::findChessboardCornersSB(grey, size, corners,
                                     cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY);
}

// A refinement that ran away from its corner, or a board found wrongly, breaks the lattice: each
// corner must lie near the middle of its neighbours in the row and in the column.
bool lattice_whole(const Points& corners, const BoardPattern& pattern) {
  const double step = shortest_step(corners, pattern);
  if (!(step >= 3)) return false;
  const auto at = [&](int r, int c) { return corners[static_cast<std::size_t>(r * pattern.columns + c)]; };
  const auto bent = [](cv::Point2f a, cv::Point2f b, cv::Point2f c) {
    return cv::norm(b - 0.5F * (a + c)) > 0.25 * cv::norm(c - a);
  };
  for (int r = 0; r < pattern.rows; ++r)
    for (int c = 0; c < pattern.columns; ++c) {
      if (c > 0 && c + 1 < pattern.columns && bent(at(r, c - 1), at(r, c), at(r, c + 1))) return false;
      if (r > 0 && r + 1 < pattern.rows && bent(at(r - 1, c), at(r, c), at(r + 1, c))) return false;
    }
  return true;
}

}  // namespace

Result<BoardCorners> find_board(const ImageView& picture, const BoardPattern& pattern) {
  RELIEVO_TRY(pattern.check());
  if (picture.empty()) return Error{Errc::InvalidInput, "there is no picture to look for a board in"};
  // OpenCV's finders throw on pictures smaller than their windows.
  if (picture.width_px < kMinSidePx || picture.height_px < kMinSidePx)
    return Error{Errc::NotFound, "no whole board found"};
  try {
    const cv::Mat grey = grey_picture(picture);
    Points found;
    if (!find(grey, pattern, found)) return Error{Errc::NotFound, "no whole board found"};
    refine(grey, pattern, found);
    if (!lattice_whole(found, pattern)) return Error{Errc::NotFound, "no regular board found"};
    BoardCorners corners;
    corners.reserve(found.size());
    for (const cv::Point2f& p : found)
      corners.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    return corners;
  } catch (const cv::Exception&) {
    return Error{Errc::LibraryFailed, "the search for the board failed in OpenCV"};
  }
}

}  // namespace relievo::pipeline
