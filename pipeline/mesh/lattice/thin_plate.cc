// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/thin_plate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relievo::pipeline {
namespace {

constexpr std::int32_t kNone = -1;
constexpr std::size_t kCoarsest = 5000;  // free places that are solved for without a coarser grid
constexpr int kMostTurns = 300,
              kTurnsBelow = 12;  // of conjugate gradients, on the coarsest grid and on those below

// One second difference: weights times places.
struct Difference {
  std::array<std::uint32_t, 4> at{};
  std::array<double, 4> weight{};
  double wanted = 0;  // where no other surface says so
};

double squared(const std::pmr::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return sum;
}

class Plate {
 public:
  Plate(std::span<double> value, const PlateGrid& grid, std::span<const std::uint32_t> free,
        std::span<const std::uint8_t> known, std::span<const double> like, std::pmr::memory_resource* memory)
      : value_(value),
        grid_(grid),
        free_(free),
        known_(known),
        like_(like),
        place_(value.size(), kNone, memory),
        placed_(known.begin(), known.end(), memory),
        differences_(memory),
        step_(free.size(), 0.0, memory),
        slope_(free.size(), 0.0, memory),
        residual_(memory),
        change_(memory),
        memory_(memory) {
    for (std::size_t i = 0; i < free.size(); ++i) place_[free[i]] = static_cast<std::int32_t>(i);
  }

  void relax() {
    const bool coarser = free_.size() > kCoarsest && std::min(grid_.columns, grid_.rows) > 8;
    if (coarser) start_from_coarser();
    spread();
    list_differences();
    solve(coarser ? kTurnsBelow : kMostTurns);
  }

 private:
  std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(grid_.columns) +
           static_cast<std::size_t>(c);
  }
  bool inside(int c, int r) const { return c >= 0 && r >= 0 && c < grid_.columns && r < grid_.rows; }
  int column(std::size_t k) const { return static_cast<int>(k) % grid_.columns; }
  int row(std::size_t k) const { return static_cast<int>(k) / grid_.columns; }
  bool guided(std::size_t k) const { return !like_.empty() && like_[k] != 0; }

  // Every second place of every second row is a plate of its own; between them lies the mean of those around.
  void start_from_coarser() {
    const PlateGrid coarse{(grid_.columns + 1) / 2, (grid_.rows + 1) / 2, grid_.height_to_width,
                           2 * grid_.tension, 4 * grid_.bow};
    const std::size_t size = static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.rows);
    std::pmr::vector<double> value(size, 0.0, memory_), like(like_.empty() ? 0 : size, 0.0, memory_);
    std::pmr::vector<std::uint8_t> known(size, 0, memory_);
    std::pmr::vector<std::uint32_t> free(memory_);
    free.reserve(free_.size() / 2);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t here =
          index(2 * (static_cast<int>(k) % coarse.columns), 2 * (static_cast<int>(k) / coarse.columns));
      value[k] = value_[here];
      known[k] = known_[here];
      if (!like_.empty()) like[k] = like_[here];
      if (place_[here] != kNone) free.push_back(static_cast<std::uint32_t>(k));
    }
    if (free.empty()) return;
    Plate(value, coarse, free, known, like, memory_).relax();
    for (const std::uint32_t k : free_) {
      double sum = 0;
      double count = 0;
      for (int dr = 0; dr <= row(k) % 2; ++dr)
        for (int dc = 0; dc <= column(k) % 2; ++dc) {
          const int c = 2 * (column(k) / 2 + dc);
          const int r = 2 * (row(k) / 2 + dr);
          if (!inside(c, r) || (known_[index(c, r)] == 0 && place_[index(c, r)] == kNone)) continue;
          const std::size_t from =
              static_cast<std::size_t>(r / 2) * static_cast<std::size_t>(coarse.columns) +
              static_cast<std::size_t>(c / 2);
          sum += value[from] + (guided(k) && guided(index(c, r)) ? like_[k] - like_[index(c, r)] : 0);
          count += 1;
        }
      if (count == 0) continue;
      value_[k] = sum / count;
      placed_[k] = 1;
    }
  }

  // From the known inwards, ring by ring, where nothing has a value yet.
  void spread() {
    std::pmr::vector<std::uint32_t> left(memory_), ring(memory_);
    left.reserve(free_.size());
    ring.reserve(free_.size());
    for (const std::uint32_t k : free_)
      if (placed_[k] == 0) left.push_back(k);
    while (!left.empty()) {
      ring.clear();
      for (const std::uint32_t k : left)
        if (place_from_neighbours(k)) ring.push_back(k);
      if (ring.empty()) return;
      for (const std::uint32_t k : ring) placed_[k] = 1;
      std::erase_if(left, [this](std::uint32_t k) { return placed_[k] != 0; });
    }
  }

  bool place_from_neighbours(std::uint32_t k) {
    double sum = 0;
    double count = 0;
    for (int r = row(k) - 1; r <= row(k) + 1; ++r)
      for (int c = column(k) - 1; c <= column(k) + 1; ++c) {
        if (!inside(c, r) || placed_[index(c, r)] == 0) continue;
        sum += value_[index(c, r)] + (guided(k) && guided(index(c, r)) ? like_[k] - like_[index(c, r)] : 0);
        count += 1;
      }
    if (count > 0) value_[k] = sum / count;
    return count > 0;
  }

  void list_differences() {
    std::size_t count = 0;
    for_each_difference([&](const Difference&) { ++count; });
    differences_.reserve(count);
    for_each_difference([this](const Difference& difference) { differences_.push_back(difference); });
  }

  template <typename Visit>
  void for_each_difference(Visit&& visit) const {
    const double across = static_cast<double>(grid_.height_to_width);  // cells may be oblong
    for (const std::uint32_t k : free_) {
      const int c = column(k);
      const int r = row(k);
      for (int d = -1; d <= 1; ++d) {
        take(k, {{{c + d - 1, r}, {c + d, r}, {c + d + 1, r}, {c + d, r}}},
             {across, -across, across, -across}, across * grid_.bow, visit);
        take(k, {{{c, r + d - 1}, {c, r + d}, {c, r + d + 1}, {c, r + d}}},
             {1 / across, -1 / across, 1 / across, -1 / across}, across * grid_.bow, visit);
      }
      if (grid_.tension > 0 && guided(k))
        for (int d = -1; d <= 0; ++d) {
          pull(k, {{{c + d, r}, {c + d + 1, r}}}, grid_.tension * std::sqrt(across), visit);
          pull(k, {{{c, r + d}, {c, r + d + 1}}}, grid_.tension / std::sqrt(across), visit);
        }
      constexpr double kTwist = 1.41421356;
      for (int dr = -1; dr <= 0; ++dr)
        for (int dc = -1; dc <= 0; ++dc)
          take(k, {{{c + dc, r + dr}, {c + dc + 1, r + dr}, {c + dc, r + dr + 1}, {c + dc + 1, r + dr + 1}}},
               {kTwist, -kTwist, -kTwist, kTwist}, 0, visit);
    }
  }

  void solve(int turns) {
    residual_.assign(differences_.size(), 0.0);
    change_.assign(differences_.size(), 0.0);
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      const auto& at = differences_[i].at;
      const bool bent = std::all_of(at.begin(), at.end(), [this](std::uint32_t k) { return guided(k); });
      residual_[i] = bent ? 0 : differences_[i].wanted;
      for (std::size_t j = 0; j < 4; ++j)
        residual_[i] -= differences_[i].weight[j] * (value_[at[j]] - (bent ? like_[at[j]] : 0));
    }
    descend();
    step_ = slope_;
    double now = squared(slope_);
    const double enough = 1e-9 * now;
    for (int turn = 0; turn < turns && now > enough; ++turn) {
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
  void take(std::uint32_t owner, const std::array<Place, 4>& places, const std::array<double, 4>& weights,
            double wanted, Visit&& visit) const {
    Difference difference;
    difference.weight = weights;
    difference.wanted = wanted;
    for (std::size_t j = 0; j < 4; ++j) {
      if (!inside(places[j].c, places[j].r)) return;
      const std::uint32_t k = static_cast<std::uint32_t>(index(places[j].c, places[j].r));
      if (known_[k] == 0 && (place_[k] == kNone || place_[k] < place_[owner])) return;
      difference.at[j] = k;
    }
    visit(difference);
  }

  template <typename Visit>
  void pull(std::uint32_t owner, const std::array<Place, 2>& places, double weight, Visit&& visit) const {
    for (const Place& p : places)
      if (!inside(p.c, p.r) || !guided(index(p.c, p.r))) return;
    take(owner, {{places[0], places[1], places[0], places[1]}}, {weight, -weight, 0, 0}, 0, visit);
  }

  void bend() {  // change_ = differences of step_
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      change_[i] = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        const std::int32_t place = place_[differences_[i].at[j]];
        if (place != kNone) change_[i] += differences_[i].weight[j] * step_[static_cast<std::size_t>(place)];
      }
    }
  }

  void descend() {  // slope_ = where the residual pulls each free place
    std::fill(slope_.begin(), slope_.end(), 0.0);
    for (std::size_t i = 0; i < differences_.size(); ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const std::int32_t place = place_[differences_[i].at[j]];
        if (place != kNone)
          slope_[static_cast<std::size_t>(place)] += differences_[i].weight[j] * residual_[i];
      }
  }

  std::span<double> value_;
  PlateGrid grid_;
  std::span<const std::uint32_t> free_;
  std::span<const std::uint8_t> known_;
  std::span<const double> like_;
  std::pmr::vector<std::int32_t> place_;   // of a place among the free ones
  std::pmr::vector<std::uint8_t> placed_;  // 1 where it has a value
  std::pmr::vector<Difference> differences_;
  std::pmr::vector<double> step_, slope_;       // one a free place
  std::pmr::vector<double> residual_, change_;  // one a difference
  std::pmr::memory_resource* memory_;
};

}  // namespace

void relax_thin_plate(std::span<double> value, const PlateGrid& grid, std::span<const std::uint32_t> free,
                      std::span<const std::uint8_t> known, std::span<const double> like,
                      std::pmr::memory_resource* memory) {
  if (!free.empty()) Plate(value, grid, free, known, like, memory).relax();
}

}  // namespace relievo::pipeline
