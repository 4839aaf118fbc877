// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/lattice.h"

#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

constexpr int kReach = 3;   // nodes, of a prediction
constexpr int kEnough = 8;  // neighbours after which no wider circle is asked
// One node's position is believed to half a pixel, the homography's change from node to node to a
// twentieth: decides only where nothing else does.
constexpr double kPerspectivePx = 10;

}  // namespace

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

int Lattice::count() const {
  int count = 0;
  for (int row = 0; row < rows_; ++row) count += count_row(row);
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
  for (LatticeNode& one : nodes_) one.at = {one.at.x * factor, one.at.y * factor};
}

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
  CornerGuess guess;
  guess.at = {h(2) + near.x, h(5) + near.y};
  guess.along_row = {h(0) - h(2) * h(6), h(3) - h(5) * h(6)};
  guess.along_column = {h(1) - h(2) * h(7), h(4) - h(5) * h(7)};
  guess.dark = lattice.dark(column, row);
  return guess;
}

}  // namespace relievo::pipeline
