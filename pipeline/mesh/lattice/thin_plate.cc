// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/thin_plate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

using mesh::plus, mesh::times;

constexpr std::int32_t kNone = -1;

// One second difference: weights times nodes.
struct Difference {
  std::array<std::uint32_t, 4> node{};
  std::array<float, 4> weight{};
};

Vec3d scaled(const Vec3f& v, float s) {
  return {static_cast<double>(v.x) * static_cast<double>(s), static_cast<double>(v.y) * static_cast<double>(s),
          static_cast<double>(v.z) * static_cast<double>(s)};
}
void add(Vec3d& sum, const Vec3d& v, double s) {
  sum.x += v.x * s;
  sum.y += v.y * s;
  sum.z += v.z * s;
}
double squared(const std::pmr::vector<Vec3d>& v) {
  double sum = 0;
  for (const Vec3d& p : v) sum += p.x * p.x + p.y * p.y + p.z * p.z;
  return sum;
}

class Plate {
 public:
  Plate(PointLattice& lattice, std::span<const std::uint32_t> free, std::span<const std::uint8_t> known,
        std::pmr::memory_resource* memory)
      : lattice_(lattice), free_(free), known_(known), place_(lattice.size(), kNone, memory), differences_(memory),
        step_(free.size(), Vec3d{}, memory), slope_(free.size(), Vec3d{}, memory), residual_(memory), change_(memory) {
    for (std::size_t i = 0; i < free.size(); ++i) place_[free[i]] = static_cast<std::int32_t>(i);
  }

  // From the known inwards, ring by ring: the mean of the neighbours that already have a place.
  void spread(std::pmr::memory_resource* memory) {
    std::pmr::vector<std::uint8_t> placed(known_.begin(), known_.end(), memory);
    std::pmr::vector<std::uint32_t> ring(memory);
    ring.reserve(free_.size());
    for (std::size_t before = free_.size() + 1, left = free_.size(); left > 0 && left < before;) {
      before = left;
      ring.clear();
      for (const std::uint32_t k : free_)
        if (!placed[k] && place_from_neighbours(k, placed)) ring.push_back(k);
      for (const std::uint32_t k : ring) placed[k] = 1;
      left -= ring.size();
    }
  }

  void list_differences() {
    const float across = lattice_.cell_height_mm / lattice_.cell_width_mm;  // cells may be oblong
    differences_.reserve(10 * free_.size());
    for (const std::uint32_t k : free_) {
      const int c = static_cast<int>(k) % lattice_.columns;
      const int r = static_cast<int>(k) / lattice_.columns;
      for (int d = -1; d <= 1; ++d) {
        take(k, {{{c + d - 1, r}, {c + d, r}, {c + d + 1, r}, {c + d, r}}}, {across, -across, across, -across});
        take(k, {{{c, r + d - 1}, {c, r + d}, {c, r + d + 1}, {c, r + d}}}, {1 / across, -1 / across, 1 / across, -1 / across});
      }
      constexpr float kTwist = 1.41421356F;
      for (int dr = -1; dr <= 0; ++dr)
        for (int dc = -1; dc <= 0; ++dc)
          take(k, {{{c + dc, r + dr}, {c + dc + 1, r + dr}, {c + dc, r + dr + 1}, {c + dc + 1, r + dr + 1}}},
               {kTwist, -kTwist, -kTwist, kTwist});
    }
  }

  void solve() {
    constexpr int kMostTurns = 300;
    residual_.assign(differences_.size(), Vec3d{});
    change_.assign(differences_.size(), Vec3d{});
    for (std::size_t i = 0; i < differences_.size(); ++i)
      for (std::size_t j = 0; j < 4; ++j)
        add(residual_[i], scaled(lattice_.at_mm[differences_[i].node[j]], differences_[i].weight[j]), -1);
    descend();
    step_ = slope_;
    double now = squared(slope_);
    const double enough = 1e-9 * now;
    for (int turn = 0; turn < kMostTurns && now > enough; ++turn) {
      bend();
      const double length = now / squared(change_);
      if (!std::isfinite(length)) return;
      for (std::size_t i = 0; i < free_.size(); ++i) {
        Vec3f& at = lattice_.at_mm[free_[i]];
        at = plus(at, {static_cast<float>(length * step_[i].x), static_cast<float>(length * step_[i].y), static_cast<float>(length * step_[i].z)});
      }
      for (std::size_t i = 0; i < residual_.size(); ++i) add(residual_[i], change_[i], -length);
      descend();
      const double before = now;
      now = squared(slope_);
      for (std::size_t i = 0; i < free_.size(); ++i) {
        Vec3d next = slope_[i];
        add(next, step_[i], now / before);
        step_[i] = next;
      }
    }
  }

 private:
  struct Place { int c, r; };

  bool place_from_neighbours(std::uint32_t k, const std::pmr::vector<std::uint8_t>& placed) {
    const int c = static_cast<int>(k) % lattice_.columns;
    const int r = static_cast<int>(k) / lattice_.columns;
    Vec3f sum{};
    float count = 0;
    for (int y = r - 1; y <= r + 1; ++y)
      for (int x = c - 1; x <= c + 1; ++x) {
        if (!lattice_.inside(x, y) || !placed[lattice_.index(x, y)]) continue;
        sum = plus(sum, lattice_.at_mm[lattice_.index(x, y)]);
        count += 1;
      }
    if (count > 0) lattice_.at_mm[k] = times(sum, 1 / count);
    return count > 0;
  }

  // Each difference once: by the first of its free nodes.
  void take(std::uint32_t owner, const std::array<Place, 4>& places, const std::array<float, 4>& weights) {
    Difference difference;
    difference.weight = weights;
    for (std::size_t j = 0; j < 4; ++j) {
      if (!lattice_.inside(places[j].c, places[j].r)) return;
      const std::uint32_t k = static_cast<std::uint32_t>(lattice_.index(places[j].c, places[j].r));
      if (!known_[k] && (place_[k] == kNone || place_[k] < place_[owner])) return;
      difference.node[j] = k;
    }
    differences_.push_back(difference);
  }

  void bend() {  // change_ = differences of step_
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      change_[i] = {};
      for (std::size_t j = 0; j < 4; ++j) {
        const std::int32_t place = place_[differences_[i].node[j]];
        if (place != kNone) add(change_[i], step_[static_cast<std::size_t>(place)], static_cast<double>(differences_[i].weight[j]));
      }
    }
  }

  void descend() {  // slope_ = where the residual pulls each free node
    std::fill(slope_.begin(), slope_.end(), Vec3d{});
    for (std::size_t i = 0; i < differences_.size(); ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const std::int32_t place = place_[differences_[i].node[j]];
        if (place != kNone) add(slope_[static_cast<std::size_t>(place)], residual_[i], static_cast<double>(differences_[i].weight[j]));
      }
  }

  PointLattice& lattice_;
  std::span<const std::uint32_t> free_;
  std::span<const std::uint8_t> known_;
  std::pmr::vector<std::int32_t> place_;  // of a node among the free ones
  std::pmr::vector<Difference> differences_;
  std::pmr::vector<Vec3d> step_, slope_;         // one a free node
  std::pmr::vector<Vec3d> residual_, change_;    // one a difference
};

}  // namespace

void relax_thin_plate(PointLattice& lattice, std::span<const std::uint32_t> free, std::span<const std::uint8_t> known,
                      std::pmr::memory_resource* memory) {
  if (free.empty()) return;
  Plate plate(lattice, free, known, memory);
  plate.spread(memory);
  plate.list_differences();
  plate.solve();
}

}  // namespace relievo::pipeline
