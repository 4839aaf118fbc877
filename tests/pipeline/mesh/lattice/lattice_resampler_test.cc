// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The resampled lattice lies on surfaces whose truth is a formula, and invents nothing.
#include "pipeline/mesh/lattice/lattice_resampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory_resource>

#include "pipeline/model/vector3.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

constexpr LatticeLimits kLimits{4, 4, 3, 0.5F};

struct Resampled {
  PointLattice from, to;
};

// 2 px of 1000 px focal length at about 500 mm: 1 mm a cell.
Resampled resample(double (*depth)(double, double), const LatticeSpacing& spacing) {
  auto* memory = std::pmr::get_default_resource();
  PointLattice lattice = make_lattice(formula_cloud(2, 300, depth, 0), memory);
  join_neighbours(lattice, kLimits, memory);
  CellMask inside(lattice.size(), 1, memory);
  ShapedLattice old{std::move(lattice), std::move(inside)};
  ThreadPool pool(2);
  ShapedLattice made = resample_lattice(old, spacing, kLimits.max_slope, pool, memory);
  return {std::move(old.lattice), std::move(made.lattice)};
}

std::size_t measured(const PointLattice& lattice) {
  std::size_t count = 0;
  for (const Node node : lattice.node) count += node == Node::Measured ? 1 : 0;
  return count;
}

class Spacing : public testing::TestWithParam<float> {};

TEST_P(Spacing, StaysOnASphereWithAsManyNodesAsTheSpacingSays) {
  const Resampled r =
      resample([](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, {GetParam(), 1});
  const auto expected = static_cast<double>(measured(r.from)) / static_cast<double>(GetParam() * GetParam());
  EXPECT_NEAR(static_cast<double>(measured(r.to)), expected, 0.08 * expected)
      << "less the horizon, too steep to carry a surface";
  double squares = 0;
  int in_front = 0;
  for (std::size_t k = 0; k < r.to.size(); ++k) {
    if (r.to.node[k] != Node::Measured) continue;
    const double off = static_cast<double>(length(minus(r.to.at_mm[k], Vec3f{0, 0, 600}))) - 90;
    EXPECT_LT(std::abs(off), 0.1) << "towards the horizon cells are long";
    if (r.to.at_mm[k].z > 530) continue;
    squares += off * off;
    ++in_front;
  }
  ASSERT_GT(in_front, 300);
  // A chord of 1 mm on this sphere sags by 1.4 um, seen askew by more: cells alone would lie that deep.
  EXPECT_LT(std::sqrt(squares / in_front), 0.0002);
}
INSTANTIATE_TEST_SUITE_P(Factors, Spacing, testing::Values(0.8F, 0.93F, 1.31F, 2.6F));

TEST(LatticeResampler, AtOneCellRepeatsWhatCarriesTheSurface) {
  const Resampled r = resample([](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, {});
  ASSERT_EQ(r.to.size(), r.from.size());
  for (std::size_t k = 0; k < r.to.size(); ++k) {
    if (r.to.node[k] == Node::Empty) continue;
    EXPECT_LT(length(minus(r.to.at_mm[k], r.from.at_mm[k])), 1e-4F);
  }
}

TEST(LatticeResampler, CellsGrowTowardsTheEdgesAndNowhereElse) {
  const Resampled even = resample([](double, double) { return 500.0; }, {1, 1});
  const Resampled r = resample([](double, double) { return 500.0; }, {1, 2});
  const PointLattice& l = r.to;
  const auto width = [&](int column) {
    const int row = l.rows / 2;
    return l.at_mm[l.index(column + 1, row)].x - l.at_mm[l.index(column, row)].x;
  };
  const float middle = width(l.columns / 2);
  EXPECT_NEAR(middle, even.to.cell_width_mm, 0.01F * middle);
  for (int c = 0; c + 1 < l.columns; ++c) {
    EXPECT_NEAR(width(c), width(l.columns - 2 - c), 0.02F * middle) << c;
    if (4 * c > l.columns && 4 * c < 3 * l.columns) {
      EXPECT_NEAR(width(c), middle, 0.01F * middle) << c;
    }
    if (c > 0 && 2 * c < l.columns) {
      EXPECT_LE(width(c), width(c - 1) + 0.001F) << c;
    }
  }
  EXPECT_NEAR(width(0), 2 * middle, 0.05F * middle);
  EXPECT_FLOAT_EQ(l.at_mm[0].x, r.from.at_mm[0].x);
  EXPECT_FLOAT_EQ(l.at_mm[l.size() - 1].y, r.from.at_mm[r.from.size() - 1].y);
}

TEST(LatticeResampler, ExpectsAsManyTrianglesAsItMakes) {
  const auto ball = [](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); };
  const auto expected = [&](float edge) {
    const Resampled old = resample(ball, {});
    const ShapedLattice surface{old.to, CellMask(std::pmr::get_default_resource())};
    return expected_triangles(surface, edge);
  };
  for (const float edge : {1.0F, 1.4F, 2.0F}) {
    double made = 0;
    for (const std::uint8_t cell : resample(ball, {1, edge}).to.cells) made += triangle_count(cell);
    EXPECT_NEAR(expected(edge), made, 0.03 * made) << edge;
  }
  EXPECT_LT(expected(2), 0.95 * expected(1));
}

TEST(LatticeResampler, BridgesNoDepthStepAndFillsNoHole) {
  const Resampled r = resample(
      [](double sx, double sy) {
        if (std::hypot(sx + 0.05, sy) < 0.02) return std::numeric_limits<double>::quiet_NaN();
        return sx > 0.0303 ? 480.0 : 500.0;
      },
      {0.8F, 1.6F});
  for (std::size_t k = 0; k < r.to.size(); ++k) {
    if (r.to.node[k] != Node::Measured) continue;
    const Vec3f& at = r.to.at_mm[k];
    const double off =
        std::min(std::abs(static_cast<double>(at.z) - 480), std::abs(static_cast<double>(at.z) - 500));
    EXPECT_LT(off, 0.01);
    EXPECT_GE(std::hypot(static_cast<double>(at.x / at.z) + 0.05, static_cast<double>(at.y / at.z)), 0.0199);
  }
  EXPECT_GT(measured(r.to), measured(r.from));
  for (int row = 0; row + 1 < r.to.rows; ++row)
    for (int column = 0; column + 1 < r.to.columns; ++column) {
      if (triangle_count(r.to.cells[r.to.index(column, row)]) < 2) continue;
      const Vec3f& a = r.to.at_mm[r.to.index(column, row)];
      const Vec3f& d = r.to.at_mm[r.to.index(column + 1, row + 1)];
      EXPECT_NEAR(a.z, d.z, 1e-3) << "a cell on both sides of the step";
    }
}

TEST(LatticeResampler, OfNothingMakesNothing) {
  auto* memory = std::pmr::get_default_resource();
  const ShapedLattice empty{PointLattice(memory), CellMask(memory)};
  ThreadPool pool(1);
  EXPECT_EQ(resample_lattice(empty, {0.8F, 1}, 4, pool, memory).lattice.size(), 0U);
}

}  // namespace
}  // namespace relievo::pipeline
