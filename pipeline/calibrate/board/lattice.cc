// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/lattice.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Core>
#include <Eigen/LU>

#include "pipeline/base/cells.h"
#include "pipeline/base/solving.h"

namespace relievo::pipeline {
int Lattice::count_row(int row) const {
  int count = 0;
  for (int column = 0; column < columns_; ++column) count += seen(column, row) ? 1 : 0;
  return count;
}

int Lattice::count_column(int column) const {
  int count = 0;
  for (int row = 0; row < rows_; ++row) count += seen(column, row) ? 1 : 0;
  return count;
}

Lattice Lattice::cut(int left, int top, int columns, int rows) const {
  Lattice out(columns, rows, dark(left, top));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      if (holds(left + column, top + row)) out.node(column, row) = node(left + column, top + row);
  return out;
}

Lattice Lattice::quarter_turned() const {
  // Row 0 of the new one is column 0, from its last node to its first; its first square, between
  // that and column 1, is the old (0, rows - 2).
  Lattice out(rows_, columns_, dark(0, rows_ - 2));
  for (int row = 0; row < columns_; ++row)
    for (int column = 0; column < rows_; ++column) out.node(column, row) = node(row, rows_ - 1 - column);
  return out;
}

void Lattice::scale(double factor) {
  for (CornerFit& one : nodes_) one.at = {one.at.x * factor, one.at.y * factor};
}

namespace {

constexpr int kReach = 3;   // nodes, of a prediction
constexpr int kEnough = 8;  // neighbours after which no wider circle is asked
// One node's position is believed to half a pixel, the homography's change from node to node to a
// twentieth: decides only where nothing else does.
constexpr double kPerspectivePx = 10;

constexpr float kMinAhead =
    0.976F;  // cosine between a half edge and the way to the next crossing: 12.5 degrees
constexpr float kMinBack = 0.94F;  // and of the half edge that comes from there: 20 degrees
constexpr float kMinStepPx = 4;
constexpr std::size_t kNeighbours = 40;  // that are asked
constexpr std::size_t kTries = 4;        // next crossings that are tried, the nearest first
constexpr int kMostSteps = 64;           // from a group's first crossing: no board is larger
constexpr float kEdgeShare = 0.3F;       // of the contrast that the edge between two crossings must show

struct Link {
  int to = -1;
  int ray = 0;
};
using Links = std::vector<std::array<Link, 4>>;

struct Neighbour {
  int who;
  float distance;
  Vec2f way;  // to it, unit
};

// Crossings by place, for those near one.
class Neighbourhood {
 public:
  Neighbourhood(std::span<const Saddle> saddles, int width_px, int height_px) : saddles_(saddles) {
    const double area = double(width_px) * height_px;
    cell_px_ = std::clamp(float(std::sqrt(2 * area / (double(saddles.size()) + 1))), 8.F, 256.F);
    cells_.fill(column(float(width_px)) + 1, column(float(height_px)) + 1, [&](auto&& add) {
      for (std::uint32_t i = 0; i < saddles.size(); ++i) add(column(saddles[i].x), column(saddles[i].y), i);
    });
  }

  // At least kNeighbours, where there are so many, the nearest among them: one ring after there are enough.
  std::vector<Neighbour> near(const Saddle& from) const {
    std::vector<Neighbour> out;
    std::size_t asked = 0;
    bool enough = false;
    const auto done = [&](int ring) {
      return ring > std::max(cells_.columns(), cells_.rows()) || std::exchange(enough, asked > kNeighbours);
    };
    cells_.by_rings(column(from.x), column(from.y), done, [&](std::uint32_t k) {
      ++asked;
      const float dx = saddles_[k].x - from.x;
      const float dy = saddles_[k].y - from.y;
      const float distance = std::sqrt(dx * dx + dy * dy);
      if (distance >= kMinStepPx) out.push_back({int(k), distance, {dx / distance, dy / distance}});
    });
    return out;
  }

 private:
  int column(float place) const { return int(place / cell_px_); }
  std::span<const Saddle> saddles_;
  float cell_px_ = 0;
  Cells cells_{std::pmr::get_default_resource()};
};

// Is there an edge all the way, with the dark side on the hand where `ray` of `from` has it?
bool edge_between(const SmoothPicture& picture, const Saddle& from, const Saddle& to, int ray) {
  const float dx = to.x - from.x;
  const float dy = to.y - from.y;
  const float distance = std::hypot(dx, dy);
  const float beside = std::clamp(0.11F * distance, 1.2F, 4.F);
  const float nx = -dy / distance * beside;
  const float ny = dx / distance * beside;
  const float least = kEdgeShare * std::min(from.contrast, to.contrast) * 16;
  for (const float t : {0.2F, 0.35F, 0.5F, 0.65F, 0.8F}) {
    const float x = from.x + t * dx;
    const float y = from.y + t * dy;
    if (!picture.holds(x + nx, y + ny) || !picture.holds(x - nx, y - ny)) return false;
    const float rise = picture.at(x - nx, y - ny) - picture.at(x + nx, y + ny);
    if ((ray % 2 == 0 ? rise : -rise) < least) return false;
  }
  return true;
}

struct Try {
  float cost = 0;
  Link link;
};

float dot(const Vec2f& a, const Vec2f& b) { return a.x * b.x + a.y * b.y; }

// The nearest crossing ahead on which a half edge of the other kind points back.
Link next_along(const SmoothPicture& picture, std::span<const Saddle> saddles,
                std::span<const Neighbour> near, int i, int ray) {
  const Saddle& from = saddles[std::size_t(i)];
  const Vec2f along = from.ray(ray);
  std::array<Try, kTries> tries;
  std::size_t count = 0;
  for (const Neighbour& one : near) {
    const float ahead = dot(one.way, along);
    if (ahead < kMinAhead) continue;
    const Saddle& to = saddles[std::size_t(one.who)];
    for (int m = 1 - ray % 2; m < 4; m += 2) {
      const float back = -dot(one.way, to.ray(m));
      if (back < kMinBack) continue;
      // A turn of t costs t² / 2 of its cosine.
      Try next{one.distance * (1 + 80 * (1 - ahead) + 20 * (1 - back)), {one.who, m}};
      for (std::size_t k = 0; k < count; ++k)
        if (next.cost < tries[k].cost) std::swap(next, tries[k]);
      if (count < kTries) tries[count++] = next;
    }
  }
  for (std::size_t k = 0; k < count; ++k)
    if (edge_between(picture, from, saddles[std::size_t(tries[k].link.to)], ray)) return tries[k].link;
  return {};
}

// Links that both ends agree on.
Links link_up(const SmoothPicture& picture, std::span<const Saddle> saddles) {
  const Neighbourhood neighbourhood(saddles, picture.width_px(), picture.height_px());
  Links links(saddles.size());
  for (std::size_t i = 0; i < saddles.size(); ++i) {
    const std::vector<Neighbour> around = neighbourhood.near(saddles[i]);
    for (int ray = 0; ray < 4; ++ray)
      links[i][std::size_t(ray)] = next_along(picture, saddles, around, int(i), ray);
  }
  Links mutual = links;
  for (std::size_t i = 0; i < saddles.size(); ++i)
    for (int ray = 0; ray < 4; ++ray) {
      const Link& link = links[i][std::size_t(ray)];
      if (link.to < 0) continue;
      const Link& back = links[std::size_t(link.to)][std::size_t(link.ray)];
      if (back.to != int(i) || back.ray != ray) mutual[i][std::size_t(ray)] = {};
    }
  return mutual;
}

struct LinkPlace {
  int column, row;
  int turn;  // half edge k points in direction (k + turn) % 4: right, down, left, up
};

// Walks over the links from one crossing; a place that is taken stays with whom it has.
std::map<std::pair<int, int>, int> walk(const Links& links, int start, std::vector<bool>& visited,
                                        std::vector<LinkPlace>& place) {
  std::map<std::pair<int, int>, int> at;
  std::vector<int> open{start};
  visited[std::size_t(start)] = true;
  place[std::size_t(start)] = {0, 0, 0};
  at[{0, 0}] = start;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const LinkPlace here = place[std::size_t(open[k])];
    for (int ray = 0; ray < 4; ++ray) {
      const Link& link = links[std::size_t(open[k])][std::size_t(ray)];
      if (link.to < 0 || visited[std::size_t(link.to)]) continue;
      const int direction = (ray + here.turn) % 4;
      constexpr std::array<int, 4> kRight{1, 0, -1, 0};
      constexpr std::array<int, 4> kDown{0, 1, 0, -1};
      const LinkPlace there{here.column + kRight[std::size_t(direction)],
                            here.row + kDown[std::size_t(direction)], (direction + 2 - link.ray + 4) % 4};
      if (std::max(std::abs(there.column), std::abs(there.row)) > kMostSteps) continue;
      if (!at.emplace(std::pair{there.column, there.row}, link.to).second) continue;
      visited[std::size_t(link.to)] = true;
      place[std::size_t(link.to)] = there;
      open.push_back(link.to);
    }
  }
  return at;
}

Lattice lattice_of(const std::map<std::pair<int, int>, int>& at, std::span<const Saddle> saddles,
                   const std::vector<LinkPlace>& place) {
  int left = 0, right = 0, top = 0, bottom = 0;
  for (const auto& [where, who] : at) {
    left = std::min(left, where.first), right = std::max(right, where.first);
    top = std::min(top, where.second), bottom = std::max(bottom, where.second);
  }
  // The square between directions right and down of node (0, 0) is dark where half edge 0 or 2 points right.
  const auto& [where, who] = *at.begin();
  const bool dark_there = place[std::size_t(who)].turn % 2 == 0;
  const bool even = (where.first - left + where.second - top) % 2 == 0;
  Lattice lattice(right - left + 1, bottom - top + 1, even == dark_there);
  for (const auto& [node, saddle] : at) {
    const Saddle& one = saddles[std::size_t(saddle)];
    lattice.node(node.first - left, node.second - top) = {
        {double(one.x), double(one.y)}, 0, double(one.contrast) / 2};
  }
  return lattice;
}

}  // namespace

std::optional<CornerGuess> predict(const Lattice& lattice, int column, int row) {
  // x = (a i + b j + c) / (g i + h j + 1), y alike with d e f; i, j counted from the node.
  Eigen::Matrix<double, 8, 8> n = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> g = Eigen::Matrix<double, 8, 1>::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Vec2d near;
  int count = 0;
  for (int ring = 1; ring <= kReach && count < kEnough; ++ring)
    for (int j = -ring; j <= ring; ++j)
      for (int i = -ring; i <= ring; ++i) {
        if (std::max(std::abs(i), std::abs(j)) != ring || !lattice.seen(column + i, row + j)) continue;
        const Vec2d& at = lattice.node(column + i, row + j).at;
        if (count++ == 0) near = at;
        const double x = at.x - near.x;
        const double y = at.y - near.y;
        Eigen::Matrix<double, 2, 8> rows;
        rows << i, j, 1, 0, 0, 0, -x * i, -x * j, 0, 0, 0, i, j, 1, -y * i, -y * j;
        const double weight = 1.0 / (i * i + j * j);
        n += weight * rows.transpose() * rows;
        g += weight * rows.transpose() * Eigen::Vector2d(x, y);
        const Eigen::Vector3d place(i, j, 1);
        spread += place * place.transpose();
      }
  // Nodes on one line say nothing about what lies beside it.
  if (count < 3 || !(spread.determinant() > 0.5)) return std::nullopt;
  n(6, 6) += kPerspectivePx * kPerspectivePx;
  n(7, 7) += kPerspectivePx * kPerspectivePx;
  const Eigen::Matrix<double, 8, 1> h = solved<8>(n, g);
  if (!h.allFinite()) return std::nullopt;
  return CornerGuess{.at = {h(2) + near.x, h(5) + near.y},
                     .along_row = {h(0) - h(2) * h(6), h(3) - h(5) * h(6)},
                     .along_column = {h(1) - h(2) * h(7), h(4) - h(5) * h(7)},
                     .dark = lattice.dark(column, row)};
}

std::vector<Lattice> find_lattices(const SmoothPicture& picture, std::span<const Saddle> saddles, int least) {
  const Links links = link_up(picture, saddles);
  std::vector<bool> visited(saddles.size());
  std::vector<LinkPlace> place(saddles.size());
  std::vector<Lattice> lattices;
  for (std::size_t i = 0; i < saddles.size(); ++i) {
    if (visited[i]) continue;
    const auto at = walk(links, int(i), visited, place);
    if (int(at.size()) >= least) lattices.push_back(lattice_of(at, saddles, place));
  }
  std::ranges::stable_sort(lattices,
                           [](const Lattice& a, const Lattice& b) { return a.count() > b.count(); });
  return lattices;
}

}  // namespace relievo::pipeline
