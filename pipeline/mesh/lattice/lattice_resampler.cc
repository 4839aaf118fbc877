// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/lattice_resampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 32;         // of rows, for the pool
constexpr double kFarthest = 190;  // mm on a chart: behind the ears
constexpr double kEvenPart = 0.4;  // of an axis, about its middle, that has cells of one size

// A place between nodes: the cell, and how far into it.
struct Place {
  int column, row;
  float tx, ty;
};

// The last node counts as the far end of the last cell.
void split(float at, int nodes, int& cell, float& t) {
  cell = std::clamp(int(at), 0, nodes - 2);
  t = at - float(cell);
}

// The weights of the four corners a, b, c, d of lattice_surface.h on the surface of the cell; all 0 off it.
std::array<float, 4> corner_weights(std::uint8_t cell, float tx, float ty) {
  switch (cell) {
    case kFalling:
    case kRising: return {(1 - tx) * (1 - ty), tx * (1 - ty), (1 - tx) * ty, tx * ty};
    case kUnder:
      if (ty >= tx) return {1 - ty, 0, ty - tx, tx};
      break;
    case kOver:
      if (tx >= ty) return {1 - tx, tx - ty, 0, ty};
      break;
    case kLeft:
      if (tx + ty <= 1) return {1 - tx - ty, tx, ty, 0};
      break;
    case kRight:
      if (tx + ty >= 1) return {0, 1 - ty, 1 - tx, tx + ty - 1};
      break;
    default: break;
  }
  return {};
}

// Of four nodes in a row, `t` of the way from the second to the third (Keys 1981, a = -1/2). At a node
// exactly that node.
std::array<float, 4> cubic_weights(float t) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  return {0.5F * (-t3 + 2 * t2 - t), 0.5F * (3 * t3 - 5 * t2 + 2), 0.5F * (-3 * t3 + 4 * t2 + t),
          0.5F * (t3 - t2)};
}

bool whole(std::uint8_t cell) { return cell == kFalling || cell == kRising; }

class Reader {
 public:
  explicit Reader(const PointLattice& lattice) : from_(lattice) {}

  Place place(float u, float v) const {
    Place at{};
    split(u, from_.columns, at.column, at.tx);
    split(v, from_.rows, at.row, at.ty);
    return at;
  }
  bool carried(float u, float v) const {
    const Place at = place(u, v);
    const std::array<float, 4> w = corner_weights(from_.cells[from_.index(at.column, at.row)], at.tx, at.ty);
    return w[0] + w[1] + w[2] + w[3] > 0;
  }

  // Whether every cell from one place to another carries surface all over.
  bool whole_around(float left, float top, float right, float bottom) const {
    const Place from = place(left, top), to = place(right, bottom);
    for (int r = from.row; r <= to.row; ++r)
      for (int c = from.column; c <= to.column; ++c)
        if (!whole(from_.cells[from_.index(c, r)])) return false;
    return true;
  }

  Node read(const Place& at, Vec3f& point, float& sigma) const {
    const std::size_t a = from_.index(at.column, at.row);
    const std::size_t below = a + std::size_t(from_.columns);
    const std::array<float, 4> w = corner_weights(from_.cells[a], at.tx, at.ty);
    const std::array<std::size_t, 4> corner{a, a + 1, below, below + 1};
    if (w[0] + w[1] + w[2] + w[3] <= 0) return Node::Empty;
    Node node = Node::Measured;
    float least_certain = 0;
    Vec3f linear{};
    for (std::size_t k = 0; k < 4; ++k) {
      if (w[k] == 0) continue;
      if (from_.node[corner[k]] == Node::Filled) node = Node::Filled;
      sigma += w[k] * from_.sigma_mm[corner[k]];
      least_certain = std::max(least_certain, from_.sigma_mm[corner[k]]);
      linear = plus(linear, times(from_.at_mm[corner[k]], w[k]));
    }
    if (node == Node::Filled) sigma = least_certain;  // a guess never passes for half a measurement
    point = smooth(at) ? cubic(at) : linear;
    return node;
  }

 private:
  bool smooth(const Place& at) const {
    if (at.column < 1 || at.row < 1 || at.column + 2 >= from_.columns || at.row + 2 >= from_.rows)
      return false;
    for (int r = -1; r <= 1; ++r)
      for (int c = -1; c <= 1; ++c)
        if (!whole(from_.cells[from_.index(at.column + c, at.row + r)])) return false;
    return true;
  }

  Vec3f cubic(const Place& at) const {
    const std::array<float, 4> wx = cubic_weights(at.tx);
    const std::array<float, 4> wy = cubic_weights(at.ty);
    Vec3f sum{};
    for (int r = 0; r < 4; ++r) {
      Vec3f row{};
      for (int c = 0; c < 4; ++c)
        row =
            plus(row, times(from_.at_mm[from_.index(at.column + c - 1, at.row + r - 1)], wx[std::size_t(c)]));
      sum = plus(sum, times(row, wy[std::size_t(r)]));
    }
    return sum;
  }

  const PointLattice& from_;
};

// How many times longer than in the middle a new cell is at `at` (0 .. 1 along the axis): 1 over kEvenPart,
// then smoothly up to `edge` at the ends.
double stretch(double at, double edge) {
  const double out = std::max(0.0, std::abs(2 * at - 1) - kEvenPart) / (1 - kEvenPart);
  return 1 + (edge - 1) * out * out * (3 - 2 * out);
}

// Where the new nodes of an axis lie on the old one: whole cells from end to end.
std::pmr::vector<float> lay_nodes(int old_nodes, const LatticeSpacing& spacing,
                                  std::pmr::memory_resource* memory) {
  const int old_cells = old_nodes - 1;
  std::pmr::vector<double> cells(std::size_t(old_nodes), 0.0,
                                 memory);  // new ones up to an old node
  for (std::size_t k = 1; k < cells.size(); ++k)
    cells[k] = cells[k - 1] + 1 / stretch((double(k) - 0.5) / old_cells, double(spacing.edge));
  const int wanted = std::max(1, int(std::lround(cells.back() / double(spacing.cells))));
  std::pmr::vector<float> at(std::size_t(wanted) + 1, float(old_cells), memory);
  std::size_t k = 1;
  for (std::size_t n = 0; n + 1 < at.size(); ++n) {
    const double reached = cells.back() * double(n) / wanted;
    while (k + 1 < cells.size() && cells[k] <= reached) ++k;
    at[n] = float(double(k - 1) + (reached - cells[k - 1]) / (cells[k] - cells[k - 1]));
  }
  return at;
}

// A cell of the new lattice in those of the old: its first corner, and how wide and high it is.
struct Window {
  float x, y, width, height;
};

// Which of the four triangles of the new cell the old surface carries, by samples no further apart than half
// an old cell.
std::uint8_t carried_parts(const Reader& reader, const Window& cell) {
  if (reader.whole_around(cell.x, cell.y, cell.x + cell.width, cell.y + cell.height))
    return kFalling | kRising;
  const int samples = 1 + int(std::ceil(2 * std::max(cell.width, cell.height)));
  std::uint8_t parts = kFalling | kRising;
  for (int j = 0; j < samples && parts != 0; ++j)
    for (int i = 0; i < samples; ++i) {
      const float x = float(i) / float(samples - 1);
      const float y = float(j) / float(samples - 1);
      if (reader.carried(cell.x + x * cell.width, cell.y + y * cell.height)) continue;
      if (j >= i) parts &= std::uint8_t(~kUnder);
      if (i >= j) parts &= std::uint8_t(~kOver);
      if (i + j <= samples - 1) parts &= std::uint8_t(~kLeft);
      if (i + j >= samples - 1) parts &= std::uint8_t(~kRight);
    }
  return parts;
}

std::uint8_t cut_cell(const PointLattice& l, int c, int r, std::uint8_t parts, float max_slope, bool closed) {
  if (parts == 0) return 0;
  const std::size_t a = l.index(c, r);
  const std::size_t below = a + std::size_t(l.columns);
  const Vec3f &p = l.at_mm[a], &q = l.at_mm[a + 1], &o = l.at_mm[below], &d = l.at_mm[below + 1];
  if (parts == (kFalling | kRising)) {
    const std::uint8_t cut = best_cut(l, a, max_slope);
    const bool completed = l.node[a] == Node::Filled || l.node[a + 1] == Node::Filled ||
                           l.node[below] == Node::Filled || l.node[below + 1] == Node::Filled;
    if (cut != 0 || !closed || !completed) return cut;
    return squared_distance(p, d) <= squared_distance(q, o) ? kFalling : kRising;
  }
  const float min_cosine = cosine_of_slope(max_slope);
  if ((parts & kUnder) && facing(p, o, d, min_cosine)) return kUnder;
  if ((parts & kOver) && facing(p, d, q, min_cosine)) return kOver;
  if ((parts & kLeft) && facing(p, o, q, min_cosine)) return kLeft;
  if ((parts & kRight) && facing(q, o, d, min_cosine)) return kRight;
  return 0;
}

}  // namespace

double expected_triangles(const ShapedLattice& old, float edge) {
  const PointLattice& l = old.lattice;
  double sum = 0;
  for (int r = 0; r + 1 < l.rows; ++r) {
    double row = 0;
    for (int c = 0; c + 1 < l.columns; ++c)
      row += triangle_count(l.cells[l.index(c, r)]) / stretch((c + 0.5) / (l.columns - 1), double(edge));
    sum += row / stretch((r + 0.5) / (l.rows - 1), double(edge));
  }
  return sum;
}

ShapedLattice resample_lattice(const ShapedLattice& old, const LatticeSpacing& spacing, float max_slope,
                               ThreadPool& pool, std::pmr::memory_resource* memory) {
  ShapedLattice made{PointLattice(memory), CellMask(memory), old.outline};
  if (old.lattice.columns < 2 || old.lattice.rows < 2) return made;
  const Reader reader(old.lattice);
  const PointLattice& from = old.lattice;
  const struct {
    std::pmr::vector<float> x, y;  // the new nodes, in cells of the old lattice
  } at{lay_nodes(from.columns, spacing, memory), lay_nodes(from.rows, spacing, memory)};
  PointLattice& l = made.lattice;
  l.lay_out(int(at.x.size()), int(at.y.size()));
  l.cell_width_mm = from.cell_width_mm * at.x.back() / float(l.columns - 1);
  l.cell_height_mm = from.cell_height_mm * at.y.back() / float(l.rows - 1);
  pool.for_each(l.rows, kBands, [&](int r) {
    for (int c = 0; c < l.columns; ++c) {
      const std::size_t k = l.index(c, r);
      l.node[k] =
          reader.read(reader.place(at.x[std::size_t(c)], at.y[std::size_t(r)]), l.at_mm[k], l.sigma_mm[k]);
    }
  });
  l.cells.assign(l.size(), 0);
  made.inside.assign(l.size(), 0);
  const auto cut = [&](int c, int r) {
    const std::size_t k = l.index(c, r);
    const auto x = std::size_t(c);
    const auto y = std::size_t(r);
    const Window cell{at.x[x], at.y[y], at.x[x + 1] - at.x[x], at.y[y + 1] - at.y[y]};
    const Place middle = reader.place(cell.x + 0.5F * cell.width, cell.y + 0.5F * cell.height);
    made.inside[k] = old.inside[old.lattice.index(middle.column, middle.row)];
    l.cells[k] = cut_cell(l, c, r, carried_parts(reader, cell), max_slope, old.outline.has_value());
  };
  pool.for_each(l.rows - 1, kBands, [&](int r) {
    for (int c = 0; c + 1 < l.columns; ++c) cut(c, r);
  });
  return made;
}

PointLattice lay_on_head(const PointLattice& old, const HeadChart& chart, float margin_mm, ThreadPool& pool,
                         std::pmr::memory_resource* memory) {
  PointLattice made(memory);
  const Vec3f centre = narrow(chart.centre_mm);
  const double step = std::sqrt(double(old.cell_width_mm) * double(old.cell_height_mm));
  std::pmr::vector<Vec2f> place(old.size(), Vec2f{}, memory);  // in steps
  pool.for_each<std::size_t>(int(old.size()), kBands, [&](std::size_t k) {
    if (old.node[k] == Node::Empty) return;
    const Vec2d p = chart.place(minus(old.at_mm[k], centre));
    place[k] = {float(p.x / step), float(p.y / step)};
  });
  float aside = 0;
  float above = 0;
  float below = 0;
  for (std::size_t k = 0; k < old.size(); ++k) {
    if (old.node[k] == Node::Empty) continue;
    aside = std::max(aside, std::abs(place[k].x));
    above = std::max(above, -place[k].y);
    below = std::max(below, place[k].y);
  }
  const auto room = [&](float reach) {
    return int(std::ceil(std::min(reach + margin_mm / float(step), float(kFarthest / step))));
  };
  const int left = room(aside);
  const int top = room(above);
  made.lay_out(2 * left + 1, top + room(below) + 1);
  made.chart = chart;
  made.step_mm = step;
  made.first_mm = {-left * step, -top * step};
  for (Vec2f& p : place) p = {p.x + float(left), p.y + float(top)};
  const Reader reader(old);
  std::pmr::vector<float> radius(made.size(), 0.0F, memory);
  for_each_triangle(old, [&](const Triangle& t) {
    const Vec2f &a = place[t[0]], &b = place[t[1]], &c = place[t[2]];
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0)
      return;  // seen from outside it turns away
    const auto corner = [&](std::uint32_t k) {
      return Vec2f{float(k % std::uint32_t(old.columns)), float(k / std::uint32_t(old.columns))};
    };
    const Vec2f oa = corner(t[0]), ob = corner(t[1]), oc = corner(t[2]);
    for_each_texel(a, b, c, made.columns, {0, made.rows}, [&](int x, int y, float wa, float wb, float wc) {
      const std::size_t k = made.index(x, y);
      Vec3f at{};
      float sigma = 0;
      const Node node = reader.read(
          reader.place(wa * oa.x + wb * ob.x + wc * oc.x, wa * oa.y + wb * ob.y + wc * oc.y), at, sigma);
      if (node != Node::Measured) return;
      at = minus(at, centre);
      const float away = length(at);
      if (away <= radius[k]) return;  // where surface stands before surface the outer one counts
      radius[k] = away;
      made.node[k] = node;
      made.at_mm[k] = at;
      made.sigma_mm[k] = sigma;
    });
  });
  measure_cells(made);
  return made;
}

}  // namespace relievo::pipeline
