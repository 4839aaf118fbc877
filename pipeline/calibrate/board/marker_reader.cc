// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/lattice.h"

#include <cmath>
#include <utility>

namespace relievo::pipeline {
namespace {

// A place on the board is believed when the modules read agree with those printed there: by their mean,
// and by so many standard deviations of what chance does; and no other place comes near.
constexpr double kMinAgreement = 0.3;
constexpr double kMinDeviations = 5;
constexpr double kMinLead = 1.3;      // over the next best
constexpr double kMostOutside = 0.1;  // of the nodes, beyond the board's rim
constexpr std::size_t kLeastMarkers = 2;

struct Reading {
  int column, row;            // of the square's first node
  std::vector<float> module;  // brightness without the border, row by row: -1 dark, 1 bright
};

// From a square (u right, v down, 0 to 1) to the picture, by its four corners (Heckbert 1989).
class SquareMap {
 public:
  SquareMap(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) : origin_(a) {  // a b over c d
    const Vec2d e{a.x - b.x - c.x + d.x, a.y - b.y - c.y + d.y};
    const Vec2d f{b.x - d.x, b.y - d.y};
    const Vec2d g{c.x - d.x, c.y - d.y};
    const double area = f.x * g.y - g.x * f.y;
    if (area == 0) return;
    g_ = (e.x * g.y - g.x * e.y) / area;
    h_ = (f.x * e.y - e.x * f.y) / area;
    right_ = {b.x - a.x + g_ * b.x, b.y - a.y + g_ * b.y};
    down_ = {c.x - a.x + h_ * c.x, c.y - a.y + h_ * c.y};
  }
  Vec2d at(double u, double v) const {
    const double w = g_ * u + h_ * v + 1;
    return {(right_.x * u + down_.x * v + origin_.x) / w, (right_.y * u + down_.y * v + origin_.y) / w};
  }

 private:
  Vec2d origin_, right_, down_;
  double g_ = 0, h_ = 0;
};

double grey_at(const ImageView& picture, const Vec2d& at) {
  if (!(at.x >= 0 && at.y >= 0 && at.x < picture.width_px - 1 && at.y < picture.height_px - 1)) return 0;
  const int x = int(at.x);
  const int y = int(at.y);
  const double u = at.x - x;
  const double v = at.y - y;
  const std::uint8_t* a = picture.row(y) + x;
  const std::uint8_t* b = picture.row(y + 1) + x;
  return (1 - v) * (a[0] + u * (a[1] - a[0])) + v * (b[0] + u * (b[1] - b[0]));
}

// Reads the square between node (column, row) and the next ones. False where there is no marker: its
// border must be dark.
bool read_square(const ImageView& picture, const Lattice& lattice, const BoardPattern& pattern,
                 Reading& reading) {
  const CornerFit& a = lattice.node(reading.column, reading.row);
  const CornerFit& b = lattice.node(reading.column + 1, reading.row);
  const CornerFit& c = lattice.node(reading.column, reading.row + 1);
  const CornerFit& d = lattice.node(reading.column + 1, reading.row + 1);
  const SquareMap map(a.at, b.at, c.at, d.at);
  const int modules = pattern.marker_bits + 2;
  const double share = pattern.marker_side_mm() / pattern.square_mm;
  const double side = share / modules;
  const double low = 0.5 - 0.5 * share;
  const double swing = (a.swing + b.swing + c.swing + d.swing) / 4;
  double border = 0;
  for (int y = 0; y < modules; ++y)
    for (int x = 0; x < modules; ++x) {
      double sum = 0;
      for (const double dv : {0.3, 0.5, 0.7})
        for (const double du : {0.3, 0.5, 0.7}) {
          const double u = low + (x + du) * side;
          const double v = low + (y + dv) * side;
          const double middle =
              (1 - v) * ((1 - u) * a.middle + u * b.middle) + v * ((1 - u) * c.middle + u * d.middle);
          sum += std::clamp((grey_at(picture, map.at(u, v)) - middle) / swing, -1.0, 1.0);
        }
      if (x == 0 || y == 0 || x == modules - 1 || y == modules - 1) border += sum;
      else reading.module.push_back(float(sum / 9));
    }
  return border < 0;
}

struct Place {
  int turns = 0, left = 0, top = 0;  // quarter turns; which node of the lattice then is the board's first
  double agreement = 0;              // mean, -1 to 1
  double deviations = 0;
};

struct Judge {
  const BoardPattern& pattern;
  const std::vector<std::uint64_t>& markers;
  Place best = {};
  double next_deviations = 0;

  void judge(const Lattice& lattice, const std::vector<Reading>& readings, Place place) {
    const int outside =
        lattice.count() - lattice.cut(place.left, place.top, pattern.columns, pattern.rows).count();
    if (outside > kMostOutside * lattice.count()) return;
    double sum = 0;
    double squares = 0;
    std::size_t modules = 0;
    for (const Reading& one : readings) {
      // The marker in this square, whose first node is (column, row) of the board, if there is one.
      const int column = one.column - place.left, row = one.row - place.top;
      if (column < -1 || row < -1 || column >= pattern.columns || row >= pattern.rows ||
          (column + row) % 2 == 0)
        return;
      const int marker = ((row + 1) * (pattern.columns + 1) + column + 1) / 2;
      // Without the mean of either: an evenly bright square agrees with nothing.
      const std::uint64_t white = markers[std::size_t(marker)];
      float mean = 0;
      float printed_mean = 0;
      for (std::size_t k = 0; k < one.module.size(); ++k) {
        mean += one.module[k];
        printed_mean += (white >> k & 1) != 0 ? 1.F : -1.F;
      }
      const auto count = float(one.module.size());
      mean /= count;
      printed_mean /= count;
      float product = 0, power = 0, printed_power = 0;
      for (std::size_t k = 0; k < one.module.size(); ++k) {
        const float read = one.module[k] - mean;
        const float printed = ((white >> k & 1) != 0 ? 1.F : -1.F) - printed_mean;
        product += read * printed;
        power += read * read;
        printed_power += printed * printed;
      }
      sum += double(product);
      squares += double(std::sqrt(power * printed_power));
      modules += one.module.size();
    }
    if (!(squares > 0)) return;
    place.agreement = sum / squares;
    place.deviations = place.agreement * std::sqrt(double(modules));
    if (place.deviations > best.deviations) std::swap(place, best);
    next_deviations = std::max(next_deviations, place.deviations);
  }

  std::optional<Place> verdict() const {
    const bool sure = best.agreement >= kMinAgreement && best.deviations >= kMinDeviations &&
                      best.deviations >= kMinLead * next_deviations;
    return sure ? std::optional(best) : std::nullopt;
  }
};

}  // namespace

std::optional<Lattice> place_on_board(const ImageView& picture, const Lattice& lattice,
                                      const BoardPattern& pattern,
                                      const std::vector<std::uint64_t>& markers) {
  std::vector<Reading> readings;
  for (int row = 0; row + 1 < lattice.rows(); ++row)
    for (int column = 0; column + 1 < lattice.columns(); ++column) {
      if (lattice.dark(column, row) || !lattice.seen(column, row) || !lattice.seen(column + 1, row) ||
          !lattice.seen(column, row + 1) || !lattice.seen(column + 1, row + 1))
        continue;
      Reading reading{column, row, {}};
      if (read_square(picture, lattice, pattern, reading)) readings.push_back(std::move(reading));
    }
  if (readings.size() < kLeastMarkers) return std::nullopt;
  Judge judge{pattern, markers};
  Lattice turned = lattice;
  for (int turns = 0; turns < 4; ++turns) {
    for (int top = 1 - pattern.rows; top < turned.rows(); ++top)
      for (int left = 1 - pattern.columns; left < turned.columns(); ++left)
        if (turned.dark(left, top)) judge.judge(turned, readings, {turns, left, top});
    for (Reading& one : readings) {  // as they read after Lattice::quarter_turned()
      const int bits = pattern.marker_bits;
      std::vector<float> modules;
      for (int v = 0; v < bits; ++v)
        for (int u = 0; u < bits; ++u) modules.push_back(one.module[std::size_t((bits - 1 - u) * bits + v)]);
      one = {turned.rows() - 2 - one.row, one.column, std::move(modules)};
    }
    turned = turned.quarter_turned();
  }
  const auto place = judge.verdict();
  if (!place) return std::nullopt;
  for (int turns = 0; turns < place->turns; ++turns) turned = turned.quarter_turned();
  return turned.cut(place->left, place->top, pattern.columns, pattern.rows);
}

}  // namespace relievo::pipeline
