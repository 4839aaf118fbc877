// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/board_tracker.h"

#include <algorithm>

#include "pipeline/calibrate/live/watch/edge_width.h"

namespace relievo::pipeline {
namespace {

// The reduced picture is at least this wide: enough for a board that fills a fifth of it. Markers must
// be read, which takes more.
constexpr int kReducedWidthPx = 600;
constexpr int kReducedCharucoPx = 900;
constexpr double kSearchMargin = 0.3;  // of the board's size, to each side of where it was
constexpr double kCropSquares = 1.6;   // around the outer corners: their squares, and some paper

// Part of a picture around the corners, and where it begins.
struct Part {
  ImageView view;
  int left_px = 0;
  int top_px = 0;
};

Part part_around(const ImageView& picture, const BoardCorners& corners, double scale, double margin) {
  double low[2] = {1e9, 1e9};
  double high[2] = {-1e9, -1e9};
  for (const Vec2d& at : corners) {
    if (!seen(at)) continue;
    low[0] = std::min(low[0], scale * at.x);
    low[1] = std::min(low[1], scale * at.y);
    high[0] = std::max(high[0], scale * at.x);
    high[1] = std::max(high[1], scale * at.y);
  }
  const double room = margin * std::max(high[0] - low[0], high[1] - low[1]) + 8;
  const auto clip = [](double at, int size) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  Part part{picture, clip(low[0] - room, picture.width_px), clip(low[1] - room, picture.height_px)};
  part.view.width_px = clip(high[0] + room, picture.width_px) - part.left_px;
  part.view.height_px = clip(high[1] + room, picture.height_px) - part.top_px;
  part.view.bytes += static_cast<std::ptrdiff_t>(part.top_px) * picture.stride_bytes +
                     static_cast<std::ptrdiff_t>(part.left_px) * bytes_per_pixel(picture.format);
  return part;
}

Result<BoardCorners> find_in(const Part& part, const BoardPattern& pattern) {
  if (part.view.empty()) return BoardCorners{};
  auto corners = find_board(part.view, pattern);
  if (!corners)
    return corners.error().code == Errc::NotFound ? Result<BoardCorners>(BoardCorners{}) : corners;
  for (Vec2d& at : *corners) at = {at.x + part.left_px, at.y + part.top_px};
  return corners;
}

template <PixelFormat kFormat>
std::uint32_t brightness(const std::uint8_t* pixel) {
  if constexpr (kFormat == PixelFormat::Rgb8) return (pixel[0] + 2U * pixel[1] + pixel[2]) / 4;
  if constexpr (kFormat == PixelFormat::Grey16) return static_cast<std::uint32_t>(pixel[0] + 256 * pixel[1]);
  return pixel[0];
}

// Adds `factor` columns of a row to each sum.
template <PixelFormat kFormat>
void add_row(const std::uint8_t* from, int factor, std::vector<std::uint32_t>& sums) {
  for (std::uint32_t& sum : sums)
    for (int k = 0; k < factor; ++k, from += bytes_per_pixel(kFormat)) sum += brightness<kFormat>(from);
}

void add_row(const ImageView& picture, int y, int factor, std::vector<std::uint32_t>& sums) {
  switch (picture.format) {
    case PixelFormat::Grey8:
      return add_row<PixelFormat::Grey8>(picture.row(y), factor, sums);
    case PixelFormat::Rgb8:
      return add_row<PixelFormat::Rgb8>(picture.row(y), factor, sums);
    case PixelFormat::Grey16:
      return add_row<PixelFormat::Grey16>(picture.row(y), factor, sums);
  }
}

}  // namespace

void BoardTracker::reduce(const ImageView& picture) {
  const int wanted = pattern_.kind == BoardKind::Chessboard ? kReducedWidthPx : kReducedCharucoPx;
  factor_ = std::max(1, std::max(picture.width_px, picture.height_px) / wanted);
  width_px_ = picture.width_px / factor_;
  height_px_ = picture.height_px / factor_;
  const auto pixels = static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
  means_.resize(pixels);
  grey_.resize(pixels);
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(width_px_));
  std::uint32_t brightest = 255;
  for (int y = 0; y < height_px_; ++y) {
    std::fill(sums.begin(), sums.end(), 0U);
    for (int k = 0; k < factor_; ++k) add_row(picture, factor_ * y + k, factor_, sums);
    for (std::size_t x = 0; x < sums.size(); ++x) {
      const std::uint32_t mean = sums[x] / static_cast<std::uint32_t>(factor_ * factor_);
      means_[static_cast<std::size_t>(y) * sums.size() + x] = static_cast<std::uint16_t>(mean);
      brightest = std::max(brightest, mean);
    }
  }
  // Cameras of 10 and 12 bit fill the lower part of 16: what is brightest becomes white.
  for (std::size_t i = 0; i < pixels; ++i) grey_[i] = static_cast<std::byte>(255U * means_[i] / brightest);
}

ImageView BoardTracker::reduced() const {
  return {grey_.data(), width_px_, height_px_, width_px_, PixelFormat::Grey8};
}

Result<BoardDetection> BoardTracker::look(const ImageView& picture) {
  if (picture.empty()) return Error{Errc::InvalidInput, "there is no picture to look for a board in"};
  reduce(picture);
  const ImageView small = reduced();
  BoardCorners found;
  if (!last_.empty()) {
    RELIEVO_TRY_ASSIGN(found, find_in(part_around(small, last_, 1, kSearchMargin), pattern_));
  }
  if (found.empty()) {
    RELIEVO_TRY_ASSIGN(found, find_in({small}, pattern_));
  }
  last_ = found;
  BoardDetection detection;
  for (const Vec2d& at : last_)
    detection.corners.push_back({factor_ * (at.x + 0.5) - 0.5, factor_ * (at.y + 0.5) - 0.5});
  if (!last_.empty()) detection.edge_px = edge_width_px(picture, detection.corners, pattern_);
  return detection;
}

Result<BoardCorners> BoardTracker::refine(const ImageView& picture) const {
  if (last_.empty()) return BoardCorners{};
  const double margin = kCropSquares / (std::max(pattern_.columns, pattern_.rows) - 1);
  return find_in(part_around(picture, last_, factor_, margin), pattern_);
}

}  // namespace relievo::pipeline
