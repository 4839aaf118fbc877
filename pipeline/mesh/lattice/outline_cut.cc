// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/mesh/lattice/surface_shaping.h"
#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {
namespace {

// Half axes of an ellipsoid around the tip of the nose, mm. It holds what 3D face recognition crops, 95 mm
// around the tip, and stands upright on the skin before the ears, so that a bump there moves the curve
// little. Downwards it holds the chin, however long.
constexpr double kAcross = 112, kUp = 101, kBack = 91;
constexpr double kJaw = 130;  // mm: from the chin the curve rises sideways as a parabola
constexpr double kBend = 12;  // mm over which the curve turns from the cheeks to below the chin

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
constexpr float kInsetCells = 0.6F;   // how far inside a straight edge a line runs at least ...
constexpr float kInsetSigmas = 0.1F;  // ... and at least: it may only take away, and waves have two sides
constexpr float kSnap = 0.25F;        // of an edge

// A Gaussian sampled half-way between whole steps, one side, all of both sides summing to 1.
std::pmr::vector<float> half_step_kernel(float sigma_cells, std::pmr::memory_resource* memory) {
  const std::size_t reach = std::size_t(std::ceil(3 * sigma_cells));
  std::pmr::vector<float> weights(reach, 0.0F, memory);
  float sum = 0;
  for (std::size_t j = 0; j < reach; ++j) {
    const float x = (float(j) + 0.5F) / sigma_cells;
    weights[j] = std::exp(-x * x / 2);
    sum += 2 * weights[j];
  }
  for (float& w : weights) w /= sum;
  return weights;
}

// How far inside the line every node lies, about in mm near it: from the share of cells that are in
// around it. `halves` says of each cell 0, 1 or 2 where it is out, half or wholly in.
template <typename Halves>
std::pmr::vector<float> depth_inside(const PointLattice& l, Halves&& halves, float sigma_mm,
                                     std::pmr::memory_resource* memory) {
  const auto along = half_step_kernel(sigma_mm / l.cell_width_mm, memory);
  const auto down = half_step_kernel(sigma_mm / l.cell_height_mm, memory);
  const std::size_t w = std::size_t(l.columns);
  std::pmr::vector<float> rows(l.size(), 0.0F, memory);
  std::pmr::vector<float> padded(w + 2 * along.size(), 0.0F, memory);
  for (std::size_t first = 0; first < l.size(); first += w) {
    float* row = padded.data() + along.size();
    for (std::size_t c = 0; c < w; ++c) row[c] = float(halves(first + c)) / 2;
    float* sum = &rows[first];
    for (std::size_t j = 0; j < along.size(); ++j)
      for (std::size_t c = 0; c < w; ++c) sum[c] += along[j] * (row[c + j] + *(row + c - j - 1));
  }
  std::pmr::vector<float> share(l.size(), 0.0F, memory);
  const std::size_t height = std::size_t(l.rows);
  for (std::size_t r = 0; r < height; ++r)
    for (std::size_t j = 0; j < 2 * down.size(); ++j) {
      const std::size_t from = r + j - down.size();  // wraps above the first row, and is then too large
      if (from >= height) continue;
      const float weight = j < down.size() ? down[down.size() - 1 - j] : down[j - down.size()];
      for (std::size_t c = 0; c < w; ++c) share[r * w + c] += weight * rows[from * w + c];
    }
  const float cell = std::max(l.cell_width_mm, l.cell_height_mm);
  const float inset = std::max(kInsetCells * cell, kInsetSigmas * sigma_mm);
  const float level = 0.5F * std::erfc(-inset / sigma_mm / std::sqrt(2.0F));
  for (float& v : share) v = (v - level) * sigma_mm;
  return share;
}

// A vertex on the way between two nodes; at a node where they are the same.
struct Place {
  std::uint32_t from, to;
  friend bool operator==(const Place&, const Place&) = default;
  friend bool operator<(const Place& a, const Place& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  }
};

class Cutter {
 public:
  Cutter(const PointLattice& lattice, float max_slope, std::pmr::memory_resource* memory)
      : lattice_(lattice), min_cosine_(cosine_of_slope(max_slope)), memory_(memory) {}

  void draw_lines(const ShapedLattice& shaped, const LatticeLimits& limits,
                  std::pmr::memory_resource* memory) {
    if (shaped.outline)
      for (std::size_t k = 0; k < over_.size(); ++k)
        if (lattice_.node[k] != Node::Empty)
          over_[k] = std::min(over_[k], shaped.outline->depth_mm(lattice_.at_mm[k]));
    if (limits.outline_mm > 0)
      take_least(depth_inside(
          lattice_, [&](std::size_t k) { return shaped.inside[k] ? 2 : 0; }, limits.outline_mm, memory));
    if (limits.rims_mm > 0)
      take_least(depth_inside(
          lattice_, [&](std::size_t k) { return triangle_count(lattice_.cells[k]); }, limits.rims_mm,
          memory));
    for_each_triangle(lattice_, [this](const Triangle& t) {
      for (std::size_t i = 0; i < 3; ++i) pull_together(t[i], t[(i + 1) % 3]);
    });
    for (std::size_t k = 0; k < snaps_.size(); ++k)
      if (snaps_[k].towards != kNone) over_[k] = 0;
  }

  FaceMesh cut(std::pmr::memory_resource* memory) {
    std::size_t triangles = 0;
    std::size_t cuts = 0;
    for_each_piece([&](const std::array<Place, 3>& piece) {
      ++triangles;
      for (const Place& p : piece)
        if (p.from == p.to) number_[p.from] = 0;
        else ++cuts;
    });
    list_cuts(cuts);
    FaceMesh result(memory);
    number_vertices(result);
    result.triangles.reserve(triangles);
    for_each_piece([&](const std::array<Place, 3>& piece) {
      result.triangles.push_back({number(piece[0]), number(piece[1]), number(piece[2])});
    });
    return result;
  }

 private:
  struct Snap {
    std::uint32_t towards = kNone;
    float share = kSnap;
  };

  void take_least(const std::pmr::vector<float>& depth) {
    for (std::size_t k = 0; k < over_.size(); ++k) over_[k] = std::min(over_[k], depth[k]);
  }

  // Where the line crosses an edge close to one of its nodes, that node shall come to the line.
  void pull_together(std::uint32_t a, std::uint32_t b) {
    if (over_[a] < 0) std::swap(a, b);
    if (!(over_[a] > 0 && over_[b] < 0)) return;
    const float share = over_[a] / (over_[a] - over_[b]);
    if (share < snaps_[a].share) snaps_[a] = {b, share};
    if (1 - share < snaps_[b].share) snaps_[b] = {a, 1 - share};
  }

  // The triangles and parts of triangles on the inner side of the line.
  template <typename Visit>
  void for_each_piece(Visit&& visit) const {
    for_each_triangle(lattice_, [&](const Triangle& t) {
      const float least = std::min({over_[t[0]], over_[t[1]], over_[t[2]]});
      const float most = std::max({over_[t[0]], over_[t[1]], over_[t[2]]});
      if (most <= 0) return;
      const std::array<Place, 3> whole{{{t[0], t[0]}, {t[1], t[1]}, {t[2], t[2]}}};
      if (least > 0) return visit(whole);
      if (!stands(t)) return;
      if (least == 0) return visit(whole);
      split(t, visit);
    });
  }

  bool stands(const Triangle& t) const {
    return facing(at({t[0], t[0]}).at_mm, at({t[1], t[1]}).at_mm, at({t[2], t[2]}).at_mm, min_cosine_);
  }

  // At least one node in and at least one out.
  template <typename Visit>
  void split(const Triangle& t, Visit&& visit) const {
    std::size_t i = 0;
    while (!(over_[t[i]] > 0 && over_[t[(i + 2) % 3]] <= 0)) ++i;  // the first that is in, going round
    const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const Place pa{a, a}, pb{b, b}, pc{c, c};
    if (over_[b] > 0) {  // c is out
      const Place ac{a, c}, bc{b, c};
      if (squared(pa, bc) <= squared(pb, ac)) {
        visit(std::array<Place, 3>{pa, pb, bc});
        visit(std::array<Place, 3>{pa, bc, ac});
      } else {
        visit(std::array<Place, 3>{pa, pb, ac});
        visit(std::array<Place, 3>{pb, bc, ac});
      }
      return;
    }
    visit(std::array<Place, 3>{pa, over_[b] < 0 ? Place{a, b} : pb, over_[c] < 0 ? Place{a, c} : pc});
  }

  float squared(const Place& a, const Place& b) const { return squared_distance(at(a).at_mm, at(b).at_mm); }

  PackedVertex at(const Place& p) const {
    if (p.from != p.to) return between(p.from, p.to, over_[p.from] / (over_[p.from] - over_[p.to]));
    const Snap& snap = snaps_[p.from];
    return snap.towards == kNone ? between(p.from, p.from, 0) : between(p.from, snap.towards, snap.share);
  }
  PackedVertex between(std::uint32_t a, std::uint32_t b, float share) const {
    const bool measured = lattice_.node[a] == Node::Measured && lattice_.node[b] == Node::Measured;
    return {plus(lattice_.at_mm[a], times(minus(lattice_.at_mm[b], lattice_.at_mm[a]), share)),
            lattice_.sigma_mm[a] + share * (lattice_.sigma_mm[b] - lattice_.sigma_mm[a]),
            measured ? std::uint8_t{1} : std::uint8_t{0}};
  }

  void list_cuts(std::size_t count) {
    cuts_.reserve(count);
    for_each_piece([this](const std::array<Place, 3>& piece) {
      for (const Place& p : piece)
        if (p.from != p.to) cuts_.push_back(p);
    });
    std::sort(cuts_.begin(), cuts_.end());
    cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
  }

  // Nodes first, in the lattice's order, then the cuts.
  void number_vertices(FaceMesh& result) {
    std::uint32_t count = 0;
    for (std::uint32_t& n : number_)
      if (n != kNone) n = count++;
    first_cut_ = count;
    count += std::uint32_t(cuts_.size());
    result.vertices_mm.reserve(count);
    result.sigma_mm.reserve(count);
    result.measured.reserve(count);
    for (std::uint32_t k = 0; k < number_.size(); ++k)
      if (number_[k] != kNone) add_vertex(result, at({k, k}));
    for (const Place& p : cuts_) add_vertex(result, at(p));
  }

  std::uint32_t number(const Place& p) const {
    if (p.from == p.to) return number_[p.from];
    return first_cut_ + std::uint32_t(std::lower_bound(cuts_.begin(), cuts_.end(), p) - cuts_.begin());
  }

  const PointLattice& lattice_;
  float min_cosine_;
  std::pmr::memory_resource* memory_;
  // Of a node: in above 0, out below, on the line at 0; where it moves; its number among the vertices.
  std::pmr::vector<float> over_{lattice_.size(), 1.0F, memory_};
  std::pmr::vector<Snap> snaps_{lattice_.size(), Snap{}, memory_};
  std::pmr::vector<std::uint32_t> number_{lattice_.size(), kNone, memory_};
  std::pmr::vector<Place> cuts_{memory_};  // sorted; from inside to outside
  std::uint32_t first_cut_ = 0;
};

}  // namespace

float FaceOutline::depth_mm(const Vec3f& from_chart_centre_mm) const {
  const Vec3d p = chart.in_head(from_chart_centre_mm);
  const double up = p.y > 0 ? kUp : std::max(kUp, below_mm + kBend);  // a long chin is the face's, too
  const double share = std::max(std::hypot(p.x / kAcross, p.y / up, p.z / kBack), 1e-3);
  const double to_reach = std::hypot(p.x, p.y, p.z) * (1 / share - 1);
  const double to_chin = p.y + below_mm - p.x * p.x / kJaw;
  // The lesser of both, rounded off.
  const double between = std::clamp(0.5 + 0.5 * (to_chin - to_reach) / kBend, 0.0, 1.0);
  return float(to_chin + between * (to_reach - to_chin) - kBend * between * (1 - between) / 2);
}

FaceMesh cut_outline(const ShapedLattice& shaped, const LatticeLimits& limits, float max_slope,
                     std::pmr::memory_resource* memory) {
  Cutter cutter(shaped.lattice, max_slope, memory);
  if (shaped.lattice.size() > 0) cutter.draw_lines(shaped, limits, memory);
  return cutter.cut(memory);
}

}  // namespace relievo::pipeline
