// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "pipeline/mesh/lattice/surface_shaping.h"

namespace relievo::pipeline {
namespace {

// Thin plate: gives free places of a grid the values that bend least between the known ones, so that a closed
// gap continues the curvature on its sides and a hole on a cheek does not become a dimple. The energy is the
// sum of squared second differences (xx, yy and twice xy) over known and free places; where free places lie
// at the edge of what is known it is linear there (natural boundary). Where `like` says another surface's
// values, the plate is bent as that one is, and over more than a length of its own it runs beside it: a
// tension (squared first differences) keeps it from leaving, as a tilt at one rim alone would have it. Least
// squares by conjugate gradients (CGLS; Hestenes, Stiefel 1952; Terzopoulos 1988 for the energy), from a
// coarse grid to the finest: far from what is known, fine steps alone would take thousands. Thread: any;
// deterministic.
struct PlateGrid {
  int columns = 0, rows = 0;
  float height_to_width = 1;  // of a cell
  double tension = 0;         // a cell's width in that length
  double bow = 0;             // what a second difference over a cell's width is where nothing says otherwise
};

constexpr std::int32_t kNone = -1;
constexpr std::size_t kCoarsest = 5000;  // free places that are solved for without a coarser grid
constexpr int kMostTurns = 300,
              kTurnsBelow = 12;  // of conjugate gradients, on the coarsest grid and on those below

// Across a row, down a column, twist; between two places that are guided, across and down.
enum DifferenceKind : std::uint32_t {
  kBendAcross,
  kBendDown,
  kTwist,
  kPullAcross,
  kPullDown,
  kDifferenceKinds
};

// One second difference: the places its kind's weights are for.
struct Difference {
  std::array<std::uint32_t, 4> at{};
  DifferenceKind kind{};
};

double squared(const std::pmr::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return sum;
}

class Plate {
 public:
  // `known`, one byte a place, are values that stay; `free` are set, none of the known, and joined to them
  // through neighbours. `like`: empty, or one a place, 0 where nothing is known of it.
  Plate(std::span<double> value, const PlateGrid& grid, std::span<const std::uint32_t> free,
        std::span<const std::uint8_t> known, std::span<const double> like, const std::atomic<bool>* cancelled,
        std::pmr::memory_resource* memory)
      : value_(value),
        grid_(grid),
        free_(free),
        known_(known),
        like_(like),
        cancelled_(cancelled),
        memory_(memory) {
    const double across = double(grid.height_to_width);  // cells may be oblong
    constexpr double kTwice = 1.41421356;
    const double pull = grid.tension;
    weights_[kBendAcross] = {across, -across, across, -across};
    weights_[kBendDown] = {1 / across, -1 / across, 1 / across, -1 / across};
    weights_[kTwist] = {kTwice, -kTwice, -kTwice, kTwice};
    weights_[kPullAcross] = {pull * std::sqrt(across), -pull * std::sqrt(across), 0, 0};
    weights_[kPullDown] = {pull / std::sqrt(across), -pull / std::sqrt(across), 0, 0};
    wanted_[kBendAcross] = wanted_[kBendDown] = across * grid.bow;
    for (std::size_t i = 0; i < free.size(); ++i) place_[free[i]] = std::int32_t(i);
  }

  void relax() {
    const bool coarser = free_.size() > kCoarsest && std::min(grid_.columns, grid_.rows) > 8;
    if (coarser) start_from_coarser();
    const auto place = [this](std::uint32_t k, auto&& each_placed_beside) {
      double sum = 0;
      double count = 0;
      each_placed_beside([&](std::uint32_t n) {
        sum += value_[n] + (guided(k) && guided(n) ? like_[k] - like_[n] : 0);
        count += 1;
      });
      value_[k] = sum / count;
    };
    spread_inwards(grid_.columns, grid_.rows, free_, placed_, place, memory_);
    std::size_t count = 0;
    for_each_difference([&](const Difference&) { ++count; });
    differences_.reserve(count);
    for_each_difference([this](const Difference& difference) { differences_.push_back(difference); });
    solve(coarser ? kTurnsBelow : kMostTurns);
  }

 private:
  bool stop() const { return cancelled_ != nullptr && cancelled_->load(std::memory_order_relaxed); }
  std::size_t index(int c, int r) const {
    return std::size_t(r) * std::size_t(grid_.columns) + std::size_t(c);
  }
  bool inside(int c, int r) const { return c >= 0 && r >= 0 && c < grid_.columns && r < grid_.rows; }
  int column(std::size_t k) const { return int(k) % grid_.columns; }
  int row(std::size_t k) const { return int(k) / grid_.columns; }
  bool guided(std::size_t k) const { return !like_.empty() && like_[k] != 0; }

  // Every second place of every second row is a plate of its own; between them lies the mean of those around.
  void start_from_coarser() {
    const PlateGrid coarse{(grid_.columns + 1) / 2, (grid_.rows + 1) / 2, grid_.height_to_width,
                           2 * grid_.tension, 4 * grid_.bow};
    const std::size_t size = std::size_t(coarse.columns) * std::size_t(coarse.rows);
    std::pmr::vector<double> value(size, 0.0, memory_), like(like_.empty() ? 0 : size, 0.0, memory_);
    std::pmr::vector<std::uint8_t> known(size, 0, memory_);
    std::pmr::vector<std::uint32_t> free(memory_);
    free.reserve(free_.size() / 2);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t here = index(2 * (int(k) % coarse.columns), 2 * (int(k) / coarse.columns));
      value[k] = value_[here];
      known[k] = known_[here];
      if (!like_.empty()) like[k] = like_[here];
      if (place_[here] != kNone) free.push_back(std::uint32_t(k));
    }
    if (free.empty()) return;
    Plate(value, coarse, free, known, like, cancelled_, memory_).relax();
    for (const std::uint32_t k : free_) {
      double sum = 0;
      double count = 0;
      for (int dr = 0; dr <= row(k) % 2; ++dr)
        for (int dc = 0; dc <= column(k) % 2; ++dc) {
          const int c = 2 * (column(k) / 2 + dc);
          const int r = 2 * (row(k) / 2 + dr);
          if (!inside(c, r) || (known_[index(c, r)] == 0 && place_[index(c, r)] == kNone)) continue;
          const std::size_t from = std::size_t(r / 2) * std::size_t(coarse.columns) + std::size_t(c / 2);
          sum += value[from] + (guided(k) && guided(index(c, r)) ? like_[k] - like_[index(c, r)] : 0);
          count += 1;
        }
      if (count == 0) continue;
      value_[k] = sum / count;
      placed_[k] = 1;
    }
  }

  template <typename Visit>
  void for_each_difference(Visit&& visit) const {
    for (const std::uint32_t k : free_) {
      const int c = column(k);
      const int r = row(k);
      for (int d = -1; d <= 1; ++d) {
        take(k, {{{c + d - 1, r}, {c + d, r}, {c + d + 1, r}, {c + d, r}}}, kBendAcross, visit);
        take(k, {{{c, r + d - 1}, {c, r + d}, {c, r + d + 1}, {c, r + d}}}, kBendDown, visit);
      }
      if (grid_.tension > 0 && guided(k))
        for (int d = -1; d <= 0; ++d) {
          pull(k, {{{c + d, r}, {c + d + 1, r}}}, kPullAcross, visit);
          pull(k, {{{c, r + d}, {c, r + d + 1}}}, kPullDown, visit);
        }
      for (int dr = -1; dr <= 0; ++dr)
        for (int dc = -1; dc <= 0; ++dc)
          take(k, {{{c + dc, r + dr}, {c + dc + 1, r + dr}, {c + dc, r + dr + 1}, {c + dc + 1, r + dr + 1}}},
               kTwist, visit);
    }
  }

  void solve(int turns) {
    residual_.assign(differences_.size(), 0.0);
    change_.assign(differences_.size(), 0.0);
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      const auto& at = differences_[i].at;
      const auto& weight = weights_[differences_[i].kind];
      const bool bent = std::ranges::all_of(at, [this](std::uint32_t k) { return guided(k); });
      residual_[i] = bent ? 0 : wanted_[differences_[i].kind];
      for (std::size_t j = 0; j < 4; ++j)
        residual_[i] -= weight[j] * (value_[at[j]] - (bent ? like_[at[j]] : 0));
    }
    for (Difference& difference : differences_)
      for (std::uint32_t& k : difference.at)
        k = place_[k] != kNone ? std::uint32_t(place_[k]) : std::uint32_t(free_.size());
    descend();
    step_ = slope_;
    double now = squared(slope_);
    const double enough = 1e-9 * now;
    for (int turn = 0; turn < turns && now > enough && !stop(); ++turn) {
      bend();
      const double length = now / squared(change_);
      if (!std::isfinite(length)) return;
      for (std::size_t i = 0; i < free_.size(); ++i) value_[free_[i]] += length * step_[i];
      for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] -= length * change_[i];
      descend();
      const double before = now;
      now = squared(slope_);
      for (std::size_t i = 0; i < free_.size(); ++i) step_[i] = slope_[i] + now / before * step_[i];
    }
  }

  struct Place {
    int c, r;
  };

  // Each difference once: by the first of its free places.
  template <typename Visit>
  void take(std::uint32_t owner, const std::array<Place, 4>& places, DifferenceKind kind,
            Visit&& visit) const {
    Difference difference;
    difference.kind = kind;
    for (std::size_t j = 0; j < 4; ++j) {
      if (!inside(places[j].c, places[j].r)) return;
      const std::uint32_t k = std::uint32_t(index(places[j].c, places[j].r));
      if (known_[k] == 0 && (place_[k] == kNone || place_[k] < place_[owner])) return;
      difference.at[j] = k;
    }
    visit(difference);
  }

  template <typename Visit>
  void pull(std::uint32_t owner, const std::array<Place, 2>& places, DifferenceKind kind,
            Visit&& visit) const {
    for (const Place& p : places)
      if (!inside(p.c, p.r) || !guided(index(p.c, p.r))) return;
    take(owner, {{places[0], places[1], places[0], places[1]}}, kind, visit);
  }

  void bend() {  // change_ = differences of step_
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      const Difference& difference = differences_[i];
      change_[i] = 0;
      for (std::size_t j = 0; j < 4; ++j)
        change_[i] += weights_[difference.kind][j] * step_[difference.at[j]];
    }
  }

  void descend() {  // slope_ = where the residual pulls each free place
    std::ranges::fill(slope_, 0.0);
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      const Difference& difference = differences_[i];
      for (std::size_t j = 0; j < 4; ++j)
        slope_[difference.at[j]] += weights_[difference.kind][j] * residual_[i];
    }
    slope_.back() = 0;
  }

  std::span<double> value_;
  PlateGrid grid_;
  std::span<const std::uint32_t> free_;
  std::span<const std::uint8_t> known_;
  std::span<const double> like_;
  const std::atomic<bool>* cancelled_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<std::int32_t> place_{value_.size(), kNone, memory_};  // of a place among the free ones
  std::pmr::vector<std::uint8_t> placed_{known_.begin(), known_.end(), memory_};  // 1 where it has a value
  std::array<std::array<double, 4>, kDifferenceKinds> weights_{};
  std::array<double, kDifferenceKinds> wanted_{};  // where no other surface says so
  std::pmr::vector<Difference> differences_{memory_};
  std::pmr::vector<double> step_{free_.size() + 1, 0.0, memory_},
      slope_{free_.size() + 1, 0.0, memory_};  // one a free place, and 0 for all that are known
  std::pmr::vector<double> residual_{memory_}, change_{memory_};  // one a difference
};

constexpr double kLeastRadiusMm = 1;
constexpr double kBesideMm = 2.5;  // over more than this a plate runs beside the surface it is like
constexpr double kBowMm = 40;  // by 1 / this skin bends back from a ball about the chart's centre by itself

// Twice the sigma of the carrying nodes nearby, from ring to ring.
void spread_sigma(PointLattice& lattice, const CellMask& carrying, std::span<const std::uint32_t> free,
                  std::pmr::memory_resource* memory) {
  CellMask known(carrying, memory);
  const auto place = [&](std::uint32_t k, auto&& each_known_beside) {
    float sum = 0;
    float count = 0;
    each_known_beside([&](std::uint32_t n) {
      sum += lattice.sigma_mm[n] * (carrying[n] ? 2 : 1);
      count += 1;
    });
    lattice.sigma_mm[k] = sum / count;
  };
  spread_inwards(lattice.columns, lattice.rows, free, known, place, memory);
  for (const std::uint32_t k : free)
    if (!known[k]) lattice.sigma_mm[k] = 1;  // an island without surface
}

// On a head's chart a node stays on its ray and the plate is one of radii: no fold can arise, and what
// nothing bends is round as a head is. Elsewhere each coordinate is a plate.
void place(PointLattice& l, std::span<const std::uint32_t> free, const CellMask& carrying,
           std::span<const double> like, const std::atomic<bool>* cancelled,
           std::pmr::memory_resource* memory) {
  if (free.empty()) return;
  PlateGrid grid{l.columns, l.rows, l.cell_height_mm / l.cell_width_mm};
  std::pmr::vector<double> value(l.size(), 0.0, memory);
  if (l.chart) {
    const double cell = double(l.cell_width_mm);
    grid.tension = cell / kBesideMm;
    grid.bow = -cell * cell / kBowMm;
    for (std::size_t k = 0; k < l.size(); ++k)
      if (carrying[k]) value[k] = l.radius_mm(k);
    Plate(value, grid, free, carrying, like, cancelled, memory).relax();
    for (const std::uint32_t k : free) l.at_mm[k] = l.on_ray(k, std::max(value[k], kLeastRadiusMm));
    return;
  }
  for (float Vec3f::*const axis : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
    for (std::size_t k = 0; k < l.size(); ++k) value[k] = double(l.at_mm[k].*axis);
    Plate(value, grid, free, carrying, {}, cancelled, memory).relax();
    for (const std::uint32_t k : free) l.at_mm[k].*axis = float(value[k]);
  }
}

}  // namespace

void fill_cells(PointLattice& lattice, const CellMask& wanted, float max_slope, std::span<const double> like,
                std::pmr::memory_resource* memory, const std::atomic<bool>* cancelled) {
  CellMask carrying(lattice.size(), 0, memory);
  CellMask listed(lattice.size(), 0, memory);
  for (int r = 0; r < lattice.rows; ++r)
    for (int c = 0; c < lattice.columns; ++c) carrying[lattice.index(c, r)] = carries_surface(lattice, c, r);
  const std::size_t w = std::size_t(lattice.columns);
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (wanted[k])
      for (const std::size_t corner : {k, k + 1, k + w, k + w + 1}) listed[corner] = !carrying[corner];
  std::pmr::vector<std::uint32_t> free(memory);
  free.reserve(std::size_t(std::ranges::count(listed, 1)));
  for (std::uint32_t k = 0; k < listed.size(); ++k)
    if (listed[k]) free.push_back(k);
  for (const std::uint32_t k : free) lattice.node[k] = Node::Filled;
  spread_sigma(lattice, carrying, free, memory);
  place(lattice, free, carrying, like, cancelled, memory);
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (wanted[k])
      if (const std::uint8_t cut = best_cut(lattice, k, max_slope)) lattice.cells[k] = cut;
}

}  // namespace relievo::pipeline
