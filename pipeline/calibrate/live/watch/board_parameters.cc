// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/board_parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

constexpr double kUsualFocal = 1.5;  // of the longer side
constexpr double kTiltWeight = 0.7;

Vec2d minus(const Vec2d& a, const Vec2d& b) { return {a.x - b.x, a.y - b.y}; }
double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }
double length(const Vec2d& a) { return std::hypot(a.x, a.y); }

// The board's plane onto the picture by least squares on the corners seen (eight unknowns; Hartley's
// scaling), then the four places asked for.
BoardOutline extrapolated(const BoardCorners& corners, const BoardPattern& pattern) {
  using Normal = Eigen::Matrix<double, 8, 8>;
  Vec2d middle;
  int count = 0;
  for (const Vec2d& at : corners)
    if (seen(at)) middle = {middle.x + at.x, middle.y + at.y}, ++count;
  if (count == 0) return {};
  middle = {middle.x / count, middle.y / count};
  double scale = 1;
  for (const Vec2d& at : corners)
    if (seen(at)) scale = std::max(scale, length(minus(at, middle)));
  const double step = 1.0 / std::max(pattern.columns, pattern.rows);
  Normal sum = Normal::Identity() * 1e-9;  // a single row of corners determines less; then it stays flat
  Eigen::Matrix<double, 8, 1> pull = Eigen::Matrix<double, 8, 1>::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!seen(corners[i])) continue;
    const int corner = int(i);
    const double x = corner % pattern.columns * step;
    const double y = corner / pattern.columns * step;
    const double u = (corners[i].x - middle.x) / scale;
    const double v = (corners[i].y - middle.y) / scale;
    Eigen::Matrix<double, 2, 8> rows;
    rows << x, y, 1, 0, 0, 0, -u * x, -u * y, 0, 0, 0, x, y, 1, -v * x, -v * y;
    sum.noalias() += rows.transpose() * rows;
    pull.noalias() += rows.transpose() * Eigen::Vector2d(u, v);
  }
  const Eigen::Matrix<double, 8, 1> h = solved<8>(sum, pull);
  BoardOutline outline;
  const double right = (pattern.columns - 1) * step;
  const double low = (pattern.rows - 1) * step;
  const double at[4][2] = {{0, 0}, {right, 0}, {right, low}, {0, low}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = at[i][0];
    const double y = at[i][1];
    const double w = std::max(h[6] * x + h[7] * y + 1, 0.05);
    outline[i] = {middle.x + scale * (h[0] * x + h[1] * y + h[2]) / w,
                  middle.y + scale * (h[3] * x + h[4] * y + h[5]) / w};
  }
  return outline;
}

// Clockwise in the picture from the corner whose edge runs most to the right: upper left first.
BoardOutline as_seen(const BoardOutline& outline) {
  const double round = cross(minus(outline[1], outline[0]), minus(outline[3], outline[0]));
  BoardOutline turned = outline;
  if (round < 0) std::swap(turned[1], turned[3]);
  std::size_t first = 0;
  double best = -2;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2d edge = minus(turned[(i + 1) % 4], turned[i]);
    const double run = edge.x / std::max(length(edge), 1e-9);
    if (run > best) best = run, first = i;
  }
  BoardOutline seen_so;
  for (std::size_t i = 0; i < 4; ++i) seen_so[i] = turned[(first + i) % 4];
  return seen_so;
}

double angle_at(const Vec2d& a, const Vec2d& at, const Vec2d& b) {
  const Vec2d u = minus(a, at);
  const Vec2d v = minus(b, at);
  const double both = length(u) * length(v);
  return both > 0 ? std::acos(std::clamp((u.x * v.x + u.y * v.y) / both, -1.0, 1.0)) : 0;
}

// Sideways and upward part of the board's normal, for a camera of usual focal length. The four corners
// of a parallelogram lie as deep as the triangles of the other three are large in the picture, and
// one over depth is linear there.
Vec2d normal_of(const BoardOutline& o, double side_px) {
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    return std::max(std::abs(cross(minus(o[b], o[a]), minus(o[c], o[a]))), 1e-9);
  };
  const double nearness[4] = {1 / triangle(1, 2, 3), 1 / triangle(0, 2, 3), 1 / triangle(0, 1, 3),
                              1 / triangle(0, 1, 2)};
  Vec2d middle;
  double mean = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    middle = {middle.x + 0.25 * o[i].x, middle.y + 0.25 * o[i].y};
    mean += 0.25 * nearness[i];
  }
  double xx = 1e-9, xy = 0, yy = 1e-9, xq = 0, yq = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2d d = minus(o[i], middle);
    const double q = nearness[i] / mean - 1;
    xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y, xq += d.x * q, yq += d.y * q;
  }
  const double scale = kUsualFocal * side_px / std::max(xx * yy - xy * xy, 1e-9);
  const Vec2d slope = {scale * (yy * xq - xy * yq), scale * (xx * yq - xy * xq)};
  const double steep = std::sqrt(1 + slope.x * slope.x + slope.y * slope.y);
  return {slope.x / steep, slope.y / steep};
}

}  // namespace

double CoverageBars::least() const { return std::min({x, y, size, skew}); }

CoverageBars lesser(const CoverageBars& a, const CoverageBars& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.size, b.size), std::min(a.skew, b.skew)};
}

void Coverage::Range::widen(const BoardParameters& by) {
  low_x = std::min(low_x, by.x);
  high_x = std::max(high_x, by.x);
  low_y = std::min(low_y, by.y);
  high_y = std::max(high_y, by.y);
  size = std::max(size, by.size);
  skew = std::max(skew, by.skew);
}

CoverageBars Coverage::bars_of(const Range& r) {
  const auto bar = [](double range, double full) { return std::clamp(range / full, 0.0, 1.0); };
  return {bar(r.high_x - r.low_x, 0.7), bar(r.high_y - r.low_y, 0.7), bar(r.size, 0.4), bar(r.skew, 0.5)};
}

CoverageBars Coverage::bars_with(const BoardParameters& one_more) const {
  Range range = range_;
  range.widen(one_more);
  return bars_of(range);
}

void Coverage::add(const BoardCorners& corners, const BoardParameters& parameters, int width_px,
                   int height_px) {
  range_.widen(parameters);
  for (const Vec2d& at : corners) {
    if (!seen(at)) continue;
    const int column = std::clamp(int((at.x + 0.5) / width_px * kCoverageColumns), 0, kCoverageColumns - 1);
    const int row = std::clamp(int((at.y + 0.5) / height_px * kCoverageRows), 0, kCoverageRows - 1);
    ++map_[std::size_t(row * kCoverageColumns + column)];
  }
}

BoardOutline outline_of(const BoardCorners& corners, const BoardPattern& pattern) {
  const auto columns = std::size_t(pattern.columns);
  const BoardOutline outline = {corners.front(), corners[columns - 1], corners.back(),
                                corners[corners.size() - columns]};
  return std::ranges::all_of(outline, [](const Vec2d& at) { return seen(at); })
             ? outline
             : extrapolated(corners, pattern);
}

BoardOutline with_border(const BoardOutline& o, const BoardPattern& pattern) {
  BoardOutline wider;
  const double u = 1.0 / (pattern.columns - 1);
  const double v = 1.0 / (pattern.rows - 1);
  const double at[4][2] = {{-u, -v}, {1 + u, -v}, {1 + u, 1 + v}, {-u, 1 + v}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double weight[4] = {(1 - at[i][0]) * (1 - at[i][1]), at[i][0] * (1 - at[i][1]), at[i][0] * at[i][1],
                              (1 - at[i][0]) * at[i][1]};
    for (std::size_t k = 0; k < 4; ++k)
      wider[i] = {wider[i].x + weight[k] * o[k].x, wider[i].y + weight[k] * o[k].y};
  }
  return wider;
}

BoardParameters parameters_of(const BoardCorners& corners, const BoardPattern& pattern, int width_px,
                              int height_px) {
  const BoardOutline outline = outline_of(corners, pattern);
  BoardParameters p;
  const double width = width_px;
  const double height = height_px;
  const double border =
      std::sqrt(0.5 * std::abs(cross(minus(outline[2], outline[0]), minus(outline[3], outline[1]))));
  Vec2d middle;
  for (const Vec2d& at : outline) middle = {middle.x + 0.25 * at.x, middle.y + 0.25 * at.y};
  p.across = (middle.x + 0.5) / width;
  p.down = (middle.y + 0.5) / height;
  p.x = std::clamp((middle.x - 0.5 * border) / std::max(width - border, 1.0), 0.0, 1.0);
  p.y = std::clamp((middle.y - 0.5 * border) / std::max(height - border, 1.0), 0.0, 1.0);
  p.size = std::min(1.0, border / std::sqrt(width * height));
  p.skew = std::min(1.0, 2 * std::abs(0.5 * std::numbers::pi - angle_at(outline[0], outline[1], outline[2])));
  const BoardOutline o = as_seen(outline);
  const Vec2d normal = normal_of(o, std::max(width, height));
  p.tilt_across = -normal.x;
  p.tilt_down = -normal.y;
  const Vec2d along = {o[1].x - o[0].x + o[2].x - o[3].x, o[1].y - o[0].y + o[2].y - o[3].y};
  p.turn_rad = std::atan2(along.y, along.x);
  return p;
}

double distance_between(const BoardParameters& a, const BoardParameters& b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.size - b.size) + std::abs(a.skew - b.skew) +
         kTiltWeight * (std::abs(a.tilt_across - b.tilt_across) + std::abs(a.tilt_down - b.tilt_down));
}

}  // namespace relievo::pipeline
