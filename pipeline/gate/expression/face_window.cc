// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "hal/base/statistics.h"
#include "pipeline/gate/expression/expression_measurement.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/match/region/face_reach.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr int kCell = 8;          // samples between places that go through the lens one by one
constexpr double kStrangeMm = 8;  // off the plane: hair, a hand, a frame of glasses
constexpr int kLeastPoints = 12;

// How far the part of the face lies behind the tip of the nose: level + across * right + slope * down.
struct Slant {
  double level = 0, across = 0, slope = 0;
  bool known = false;
};

Slant fit_plane(const Relief& relief, const HeadMeasurement& head, const WindowBox& box) {
  Slant slant;
  const double step = std::max(2.0, head.tip_mm.z / relief.focal_px);
  for (int round = 0; round < 3; ++round) {
    ThreeTerms terms;
    int count = 0;
    for (double down = box.down0_mm; down <= box.down1_mm; down += step)
      for (double right = box.right0_mm; right <= box.right1_mm; right += step) {
        const FacePlace place = place_on(relief, head, right, down);
        if (!place.inside || !relief.known(place.x, place.y)) continue;
        const double behind = dot(minus(relief.point(place.x, place.y), head.tip_mm), head.away);
        if (slant.known
                ? std::abs(behind - slant.level - slant.across * right - slant.slope * down) > kStrangeMm
                : behind < -20 || behind > 60)
          continue;
        terms.add({1, right, down}, behind);
        ++count;
      }
    const auto k = terms.solve();
    if (count < kLeastPoints || !k) return slant;
    slant = {(*k)[0], (*k)[1], (*k)[2], true};
  }
  return slant;
}

float luminance(const ImageView& image, int x, int y) {
  const std::uint8_t* row = image.row(y);
  switch (image.format) {
    case PixelFormat::Rgb8: return float(row[3 * x] + row[3 * x + 1] + row[3 * x + 2]) / 3.0F;
    case PixelFormat::Grey16: return float(row[2 * x] + 256 * row[2 * x + 1]) / 257.0F;
    case PixelFormat::Grey8: break;
  }
  return row[x];
}

// The mean of `side` x `side` samples between pixels, one pixel apart, about (x, y).
float sample(const ImageView& image, Vec2d at, int side) {
  const double left = at.x - (side - 1) / 2.0, top = at.y - (side - 1) / 2.0;
  const int x0 = int(std::floor(left)), y0 = int(std::floor(top));
  const auto u = float(left - x0), v = float(top - y0);
  float sum = 0;
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) {
      const float weight = (i == 0 ? 1 - u : i == side ? u : 1.0F) * (j == 0 ? 1 - v : j == side ? v : 1.0F);
      sum += weight * luminance(image, x0 + i, y0 + j);
    }
  return sum / float(side * side);
}

// Source pixels of a lattice of cells, and between them.
class Lattice {
 public:
  Lattice(const FacePhoto& photo, const Slant& slant, const FaceWindow& window,
          std::pmr::memory_resource* memory)
      : across_((window.columns - 1) / kCell + 2), nodes_(memory) {
    const int along = (window.rows - 1) / kCell + 2;
    nodes_.reserve(std::size_t(across_ * along));
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < across_; ++i)
        nodes_.push_back(pixel(photo, slant, window.right_mm(i * kCell), window.down_mm(j * kCell)));
  }
  Vec2d at(int x, int y) const {
    const auto k = std::size_t(y / kCell * across_ + x / kCell);
    const double u = double(x % kCell) / kCell, v = double(y % kCell) / kCell;
    const auto across = std::size_t(across_);
    const auto mix = [&](double a, double b, double c, double d) {
      return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
    };
    return {mix(nodes_[k].x, nodes_[k + 1].x, nodes_[k + across].x, nodes_[k + across + 1].x),
            mix(nodes_[k].y, nodes_[k + 1].y, nodes_[k + across].y, nodes_[k + across + 1].y)};
  }

 private:
  static Vec2d pixel(const FacePhoto& photo, const Slant& slant, double right, double down) {
    const HeadMeasurement& h = photo.head;
    const double behind = slant.level + slant.across * right + slant.slope * down;
    const Vec3d p = along(along(along(h.tip_mm, right, h.right), down, h.down), behind, h.away);
    return source_pixel(photo.calibration.left, photo.relief.rectified_from_left, 1, {0, 0},
                        {p.x / p.z, p.y / p.z});
  }
  int across_;
  std::pmr::vector<Vec2d> nodes_;
};

}  // namespace

double FaceWindow::between(double right_mm, double down_mm) const {
  const double x = std::clamp(column(right_mm), 0.0, columns - 1.001),
               y = std::clamp(row(down_mm), 0.0, rows - 1.001);
  const int x0 = int(x), y0 = int(y);
  const double u = x - x0, v = y - y0;
  return (1 - v) * ((1 - u) * double(at(x0, y0)) + u * double(at(x0 + 1, y0))) +
         v * ((1 - u) * double(at(x0, y0 + 1)) + u * double(at(x0 + 1, y0 + 1)));
}

FaceWindow cut_window(const FacePhoto& photo, const WindowBox& box, StageContext& context) {
  FaceWindow window(&context.scratch);
  if (!photo.head.known || photo.frame.left.empty()) return window;
  const Slant slant = fit_plane(photo.relief, photo.head, box);
  if (!slant.known) return window;
  window.box = box;
  window.columns = int((box.right1_mm - box.right0_mm) / FaceWindow::kStepMm) + 1;
  window.rows = int((box.down1_mm - box.down0_mm) / FaceWindow::kStepMm) + 1;
  const Lattice lattice(photo, slant, window, &context.scratch);
  const ImageView& image = photo.frame.left;
  const Vec2d a = lattice.at(0, 0), b = lattice.at(0, window.rows - 1);
  const double pixels = std::hypot(b.x - a.x, b.y - a.y) / (window.rows - 1);  // a sample
  const int side = std::clamp(int(std::lround(pixels)), 1, 8);
  window.grey.reserve(std::size_t(window.columns * window.rows));
  for (int y = 0; y < window.rows; ++y)
    for (int x = 0; x < window.columns; ++x) {
      const Vec2d at = lattice.at(x, y);
      if (!(at.x > side && at.y > side && at.x < image.width_px - side - 1 &&
            at.y < image.height_px - side - 1)) {
        window.grey.clear();
        return window;
      }
      window.grey.push_back(sample(image, at, side));
    }
  return window;
}

double quantile(const FaceWindow& window, const WindowBox& box, double share, StageContext& context) {
  const int x0 = std::max(0, int(window.column(box.right0_mm))),
            x1 = std::min(window.columns - 1, int(window.column(box.right1_mm)));
  const int y0 = std::max(0, int(window.row(box.down0_mm))),
            y1 = std::min(window.rows - 1, int(window.row(box.down1_mm)));
  if (window.empty() || x1 < x0 || y1 < y0) return 0;
  std::pmr::vector<float> values(&context.scratch);
  values.reserve(std::size_t((x1 - x0 + 1) * (y1 - y0 + 1)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) values.push_back(window.at(x, y));
  return percentile(values, share);
}

}  // namespace relievo::pipeline
