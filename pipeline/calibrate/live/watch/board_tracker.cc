// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/board_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/base/statistics.h"

namespace relievo::pipeline {
namespace {

constexpr double kStepPx = 0.25;      // between samples of a profile
constexpr double kMaxReachPx = 16;    // of a profile, from the edge to either side
constexpr double kReachShare = 0.3;   // of the distance between corners, on plain squares
constexpr double kMarkerReach = 0.8;  // of the way to a ChArUco square's marker
constexpr double kMinReachPx = 2.5;
constexpr double kAlong[] = {-0.15, 0, 0.15};  // profiles that are averaged, from the edge's middle
constexpr double kMinContrast = 0.02;          // of full scale
constexpr int kMaxSamples = int(2 * kMaxReachPx / kStepPx) + 1;

class Brightness {
 public:
  explicit Brightness(const ImageView& picture) : picture_(picture) {}
  double full_scale() const { return picture_.format == PixelFormat::Grey16 ? 65535 : 255; }
  bool holds(double x, double y) const {
    return x >= 0 && y >= 0 && x < picture_.width_px - 1 && y < picture_.height_px - 1;
  }
  double at(double x, double y) const {
    const int column = int(x);
    const int row = int(y);
    const double u = x - column;
    const double v = y - row;
    return (1 - v) * ((1 - u) * pixel(column, row) + u * pixel(column + 1, row)) +
           v * ((1 - u) * pixel(column, row + 1) + u * pixel(column + 1, row + 1));
  }

 private:
  double pixel(int column, int row) const {
    const std::uint8_t* bytes = picture_.row(row) + std::ptrdiff_t(column) * bytes_per_pixel(picture_.format);
    switch (picture_.format) {
      case PixelFormat::Grey8: return bytes[0];
      case PixelFormat::Rgb8: return 0.25 * bytes[0] + 0.5 * bytes[1] + 0.25 * bytes[2];
      case PixelFormat::Grey16: return bytes[0] + 256.0 * bytes[1];  // the machine's order: little-endian
    }
    return 0;
  }
  const ImageView& picture_;
};

using Profile = std::array<double, kMaxSamples>;

// Averaged along the edge from a to b; false where it leaves the picture.
bool profile_of(const Brightness& picture, const Vec2d& a, const Vec2d& b, double reach_px, Profile& profile,
                int count) {
  const Vec2d along = {b.x - a.x, b.y - a.y};
  const double length = std::hypot(along.x, along.y);
  const Vec2d normal = {-along.y / length, along.x / length};
  profile.fill(0);
  for (const double share : kAlong)
    for (int i = 0; i < count; ++i) {
      const double out = -reach_px + i * kStepPx;
      const double x = a.x + (0.5 + share) * along.x + out * normal.x;
      const double y = a.y + (0.5 + share) * along.y + out * normal.y;
      if (!picture.holds(x, y)) return false;
      profile[std::size_t(i)] += picture.at(x, y) / double(std::size(kAlong));
    }
  return true;
}

// Distance from the middle crossing outwards (`step` -1 or 1) to where `level` is passed, in samples.
double passed(const Profile& profile, int count, int from, int step, double level) {
  const bool rising = profile[std::size_t(from)] < level;
  for (int i = from; i >= 0 && i < count; i += step) {
    const double now = profile[std::size_t(i)];
    if ((now < level) == rising) continue;
    const double before = profile[std::size_t(i - step)];
    return std::abs(i - from) - 1 + (level - before) / (now - before);
  }
  return step < 0 ? from : count - 1 - from;
}

double width_of(const Profile& profile, int count, double least_contrast) {
  const int plain = std::max(1, count / 8);
  double first = 0;
  double last = 0;
  for (int i = 0; i < plain; ++i) {
    first += profile[std::size_t(i)] / plain;
    last += profile[std::size_t(count - 1 - i)] / plain;
  }
  const double contrast = last - first;
  if (std::abs(contrast) < least_contrast) return 0;
  // The crossing nearest to where the corners say the edge is.
  const int middle = count / 2;
  int crossing = -1;
  for (int off = 0; off < count / 3 && crossing < 0; ++off)
    for (const int i : {middle - off, middle + off}) {
      const double a = (profile[std::size_t(i)] - first) / contrast - 0.5;
      const double b = (profile[std::size_t(i + 1)] - first) / contrast - 0.5;
      if (a <= 0 && b > 0) crossing = i;
    }
  if (crossing < 1 || crossing + 2 >= count) return 0;
  const double down = passed(profile, count, crossing + 1, -1, first + 0.1 * contrast);
  const double up = passed(profile, count, crossing, 1, first + 0.9 * contrast);
  return (down + up - 1) * kStepPx;
}

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
  const auto clip = [](double at, int size) { return int(std::clamp(at, 0.0, double(size))); };
  Part part{picture, clip(low[0] - room, picture.width_px), clip(low[1] - room, picture.height_px)};
  part.view.width_px = clip(high[0] + room, picture.width_px) - part.left_px;
  part.view.height_px = clip(high[1] + room, picture.height_px) - part.top_px;
  part.view.bytes += std::ptrdiff_t(part.top_px) * picture.stride_bytes +
                     std::ptrdiff_t(part.left_px) * bytes_per_pixel(picture.format);
  return part;
}

Result<BoardCorners> find_in(const Part& part, const BoardPattern& pattern) {
  if (part.view.empty()) return BoardCorners{};
  RELIEVO_TRY_ASSIGN(auto corners, look_for_board(part.view, pattern));
  for (Vec2d& at : corners) at = {at.x + part.left_px, at.y + part.top_px};
  return corners;
}

template <PixelFormat kFormat>
std::uint32_t brightness(const std::uint8_t* pixel) {
  if constexpr (kFormat == PixelFormat::Rgb8) return (pixel[0] + 2U * pixel[1] + pixel[2]) / 4;
  if constexpr (kFormat == PixelFormat::Grey16) return std::uint32_t(pixel[0] + 256 * pixel[1]);
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
    case PixelFormat::Grey8: return add_row<PixelFormat::Grey8>(picture.row(y), factor, sums);
    case PixelFormat::Rgb8: return add_row<PixelFormat::Rgb8>(picture.row(y), factor, sums);
    case PixelFormat::Grey16: return add_row<PixelFormat::Grey16>(picture.row(y), factor, sums);
  }
}

}  // namespace

double edge_width_px(const ImageView& picture, const BoardCorners& corners, const BoardPattern& pattern) {
  const Brightness brightness(picture);
  const double plain =
      pattern.kind == BoardKind::Chessboard
          ? kReachShare
          : std::min(kReachShare, kMarkerReach * 0.5 * (1 - pattern.marker_side_mm() / pattern.square_mm));
  std::array<std::vector<double>, 2> widths;  // of edges along rows, along columns
  Profile profile;
  for (int row = 0; row < pattern.rows; ++row)
    for (int column = 0; column < pattern.columns; ++column)
      for (const bool down : {false, true}) {
        if ((down ? row + 1 >= pattern.rows : column + 1 >= pattern.columns)) continue;
        const auto here = std::size_t(row * pattern.columns + column);
        const Vec2d& a = corners[here];
        const Vec2d& b = corners[here + std::size_t(down ? pattern.columns : 1)];
        if (!seen(a) || !seen(b)) continue;
        const double reach_px = std::min(kMaxReachPx, plain * std::hypot(b.x - a.x, b.y - a.y));
        if (reach_px < kMinReachPx) continue;
        const int count = int(2 * reach_px / kStepPx) + 1;
        if (!profile_of(brightness, a, b, reach_px, profile, count)) continue;
        const double width = width_of(profile, count, kMinContrast * brightness.full_scale());
        if (width > 0) widths[down ? 1 : 0].push_back(width);
      }
  double widest = 0;
  for (std::vector<double>& way : widths)
    if (!way.empty()) widest = std::max(widest, median(way));
  return widest;
}

void BoardTracker::reduce(const ImageView& picture) {
  const int wanted = pattern_.kind == BoardKind::Chessboard ? kReducedWidthPx : kReducedCharucoPx;
  factor_ = std::max(1, std::max(picture.width_px, picture.height_px) / wanted);
  width_px_ = picture.width_px / factor_;
  height_px_ = picture.height_px / factor_;
  const auto pixels = std::size_t(width_px_) * std::size_t(height_px_);
  means_.resize(pixels);
  grey_.resize(pixels);
  auto sums = std::vector<std::uint32_t>(std::size_t(width_px_));
  std::uint32_t brightest = 255;
  for (int y = 0; y < height_px_; ++y) {
    std::ranges::fill(sums, 0U);
    for (int k = 0; k < factor_; ++k) add_row(picture, factor_ * y + k, factor_, sums);
    for (std::size_t x = 0; x < sums.size(); ++x) {
      const std::uint32_t mean = sums[x] / std::uint32_t(factor_ * factor_);
      means_[std::size_t(y) * sums.size() + x] = std::uint16_t(mean);
      brightest = std::max(brightest, mean);
    }
  }
  // Files of 10 and 12 bit cameras may fill the lower part of 16 only: what is brightest becomes white.
  for (std::size_t i = 0; i < pixels; ++i) grey_[i] = static_cast<std::byte>(255U * means_[i] / brightest);
}

Result<BoardDetection> BoardTracker::look(const ImageView& picture) {
  if (picture.empty()) return invalid("there is no picture to look for a board in");
  reduce(picture);
  const ImageView small{grey_.data(), width_px_, height_px_, width_px_, PixelFormat::Grey8};
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
