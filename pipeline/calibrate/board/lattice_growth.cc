// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/lattice_growth.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace relievo::pipeline {
namespace {

constexpr double kStrayFactor = 6;  // times the usual distance from where the neighbours say

double distance(const Vec2d& a, const Vec2d& b) { return std::hypot(a.x - b.x, a.y - b.y); }

void take(CornerRefiner& refiner, const CornerGuess& guess, LatticeNode& node) {
  const auto fit = refiner.refine(guess);
  if (fit) node = {fit->at, fit->middle, fit->swing};
  else node.swing = 0;
}

int neighbours(const Lattice& lattice, int column, int row) {
  return (lattice.seen(column - 1, row) ? 1 : 0) + (lattice.seen(column + 1, row) ? 1 : 0) +
         (lattice.seen(column, row - 1) ? 1 : 0) + (lattice.seen(column, row + 1) ? 1 : 0);
}

}  // namespace

void refine_nodes(CornerRefiner& refiner, Lattice& lattice) {
  const Lattice before = lattice;  // predictions from places of one kind
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column) {
      if (!before.seen(column, row)) continue;
      auto guess = predict(before, column, row);
      if (!guess) {
        lattice.node(column, row).swing = 0;
        continue;
      }
      guess->at = before.node(column, row).at;
      take(refiner, *guess, lattice.node(column, row));
    }
}

void fill_gaps(CornerRefiner& refiner, Lattice& lattice) {
  // How many neighbours were seen when a node was last looked for in vain: with more it is worth another
  // look.
  std::vector<int> tried(static_cast<std::size_t>(lattice.columns()) *
                         static_cast<std::size_t>(lattice.rows()));
  for (bool grown = true; grown;) {
    grown = false;
    for (int row = 0; row < lattice.rows(); ++row)
      for (int column = 0; column < lattice.columns(); ++column) {
        if (lattice.seen(column, row)) continue;
        int& before = tried[static_cast<std::size_t>(row) * static_cast<std::size_t>(lattice.columns()) +
                            static_cast<std::size_t>(column)];
        const int around = neighbours(lattice, column, row);
        if (around <= before) continue;
        before = around;
        const auto guess = predict(lattice, column, row);
        if (!guess) continue;
        take(refiner, *guess, lattice.node(column, row));
        grown = grown || lattice.seen(column, row);
      }
  }
}

void drop_strays(Lattice& lattice, double least_px) {
  std::vector<double> off;
  std::vector<double> usual;
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column) {
      const auto guess = lattice.seen(column, row) ? predict(lattice, column, row) : std::nullopt;
      off.push_back(guess ? distance(guess->at, lattice.node(column, row).at) : 0);
      if (guess) usual.push_back(off.back());
    }
  if (usual.empty()) return;
  const auto middle = usual.begin() + static_cast<std::ptrdiff_t>(usual.size() / 2);
  std::nth_element(usual.begin(), middle, usual.end());
  const double limit = std::max(least_px, kStrayFactor * *middle);
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column)
      if (off[static_cast<std::size_t>(row) * static_cast<std::size_t>(lattice.columns()) +
              static_cast<std::size_t>(column)] > limit)
        lattice.node(column, row).swing = 0;
}

double step_px(const Lattice& lattice) {
  double sum = 0;
  int count = 0;
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column)
      for (const auto& [right, down] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (!lattice.seen(column, row) || !lattice.seen(column + right, row + down)) continue;
        sum += distance(lattice.node(column, row).at, lattice.node(column + right, row + down).at);
        ++count;
      }
  return count > 0 ? sum / count : 0;
}

}  // namespace relievo::pipeline
