// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/bending/bending_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

// The slow twin: the same operator as a dense matrix, built difference by difference.
Eigen::MatrixXd dense(const BendingSystem& s) {
  const int w = s.width();
  const int h = s.height();
  const auto id = [w](int x, int y) { return y * w + x; };
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(w * h, w * h);
  const auto add = [&](float weight, std::initializer_list<std::pair<int, double>> difference) {
    for (const auto& [i, a] : difference)
      for (const auto& [j, b] : difference) m(i, j) += static_cast<double>(weight) * a * b;
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      m(id(x, y), id(x, y)) += static_cast<double>(s.data.row(y)[x]);
      if (s.bend_xx.row(y)[x] > 0)
        add(s.bend_xx.row(y)[x], {{id(x - 1, y), 1}, {id(x, y), -2}, {id(x + 1, y), 1}});
      if (s.bend_yy.row(y)[x] > 0)
        add(s.bend_yy.row(y)[x], {{id(x, y - 1), 1}, {id(x, y), -2}, {id(x, y + 1), 1}});
      if (s.bend_xy.row(y)[x] > 0)
        add(s.bend_xy.row(y)[x],
            {{id(x, y), 1}, {id(x + 1, y), -1}, {id(x, y + 1), -1}, {id(x + 1, y + 1), 1}});
    }
  return m;
}

// Weights on an inner domain only, as the refiner sets them, with a hole.
void fill(BendingSystem& s, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.1F, 1);
  const auto in = [&](int x, int y) {
    return x >= 1 && y >= 1 && x < s.width() - 1 && y < s.height() - 1 &&
           !(x >= 5 && x < 7 && y >= 4 && y < 6);
  };
  for (int y = 0; y < s.height(); ++y)
    for (int x = 0; x < s.width(); ++x) {
      if (!in(x, y)) continue;
      s.data.row(y)[x] = unit(random);
      s.rhs.row(y)[x] = unit(random) - 0.5F;
      if (in(x - 1, y) && in(x + 1, y)) s.bend_xx.row(y)[x] = 20 * unit(random);
      if (in(x, y - 1) && in(x, y + 1)) s.bend_yy.row(y)[x] = 20 * unit(random);
      if (in(x + 1, y) && in(x, y + 1) && in(x + 1, y + 1)) s.bend_xy.row(y)[x] = 20 * unit(random);
    }
}

TEST(BendingSystem, AppliesLikeItsDenseTwin) {
  test::StageFixture fixture(1 << 20, 1 << 20);
  BendingSystem s(&fixture.scratch, 13, 11);
  fill(s, 1);
  Plane<float> x(&fixture.scratch, 13, 11);
  std::mt19937 random(2);
  for (int j = 1; j < 10; ++j)
    for (int i = 1; i < 12; ++i)
      x.row(j)[i] = s.data.row(j)[i] > 0 ? std::uniform_real_distribution<float>(-1, 1)(random) : 0.0F;
  Plane<float> out(&fixture.scratch, 13, 11);
  Plane<float> rolling(&fixture.scratch, rolling_floats(13), 1);
  // In two bands, as threads do it.
  apply_system(s, x, true, out, 0, 4, rolling.row(0));
  apply_system(s, x, true, out, 4, 11, rolling.row(0));
  const Eigen::MatrixXd m = dense(s);
  Eigen::VectorXd v(13 * 11);
  for (std::size_t k = 0; k < x.values.size(); ++k)
    v(static_cast<long>(k)) = static_cast<double>(x.values[k]);
  const Eigen::VectorXd expected = m * v;
  for (std::size_t k = 0; k < out.values.size(); ++k)
    EXPECT_NEAR(static_cast<double>(out.values[k]), expected(static_cast<long>(k)), 2e-4) << k;
}

TEST(BendingSystem, SolvesLikeItsDenseTwin) {
  test::StageFixture fixture(1 << 20, 1 << 22);
  BendingSystem s(&fixture.scratch, 13, 11);
  fill(s, 3);
  Plane<float> x(&fixture.scratch, 13, 11);
  solve(s, 400, kToTheEnd, fixture.pool, fixture.scratch, x);
  Eigen::MatrixXd m = dense(s);
  Eigen::VectorXd b(13 * 11);
  for (std::size_t k = 0; k < s.rhs.values.size(); ++k) {
    b(static_cast<long>(k)) = static_cast<double>(s.rhs.values[k]);
    if (m(static_cast<long>(k), static_cast<long>(k)) == 0) m(static_cast<long>(k), static_cast<long>(k)) = 1;
  }
  const Eigen::VectorXd expected = m.ldlt().solve(b);
  for (std::size_t k = 0; k < x.values.size(); ++k)
    EXPECT_NEAR(static_cast<double>(x.values[k]), expected(static_cast<long>(k)), 2e-3) << k;
}

// Skin that says little: one node in sixteen is known, and a little. What the few say must reach all the
// others.
void fill_sparsely(BendingSystem& s) {
  fill(s, 7);
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(0.5F, 1);
  for (int y = 0; y < s.height(); ++y)
    for (int x = 0; x < s.width(); ++x) {
      if (s.data.row(y)[x] == 0) continue;
      const bool known = x % 4 == 1 && y % 4 == 1;
      s.data.row(y)[x] = known ? 0.1F * unit(random) : 0.0F;
      s.rhs.row(y)[x] = known ? s.data.row(y)[x] * std::sin(0.1F * static_cast<float>(x + 2 * y)) : 0.0F;
    }
}

TEST(BendingSystem, IsSolvedInFewStepsWhereLittleIsKnown) {
  constexpr int kWidth = 45, kHeight = 38;
  test::StageFixture fixture(1 << 20, 1 << 22);
  BendingSystem s(&fixture.scratch, kWidth, kHeight);
  fill_sparsely(s);
  Plane<float> x(&fixture.scratch, kWidth, kHeight);
  solve(s, 40, kToTheEnd, fixture.pool, fixture.scratch, x);
  Eigen::MatrixXd m = dense(s);
  Eigen::VectorXd b(kWidth * kHeight);
  for (std::size_t k = 0; k < s.rhs.values.size(); ++k) {
    b(static_cast<long>(k)) = static_cast<double>(s.rhs.values[k]);
    if (m(static_cast<long>(k), static_cast<long>(k)) == 0) m(static_cast<long>(k), static_cast<long>(k)) = 1;
  }
  const Eigen::VectorXd expected = m.ldlt().solve(b);
  double worst = 0;
  for (std::size_t k = 0; k < x.values.size(); ++k)
    worst = std::max(worst, std::abs(static_cast<double>(x.values[k]) - expected(static_cast<long>(k))));
  EXPECT_LT(worst, 0.02 * expected.cwiseAbs().maxCoeff());
}

// As the header has it: four planes of its own and the preconditioner's, and a tenth for borders and rows.
TEST(BendingSystem, TakesThePlanesItSays) {
  constexpr int kWidth = 400, kHeight = 300;
  test::StageFixture fixture(4 << 20, 8 << 20);
  BendingSystem s(&fixture.output, kWidth, kHeight);
  fill(s, 5);
  Plane<float> x(&fixture.output, kWidth, kHeight);
  solve(s, 2, kToTheEnd, fixture.pool, fixture.scratch, x);
  EXPECT_LT(static_cast<double>(fixture.scratch.used()), 1.1 * 25 / 3 * kWidth * kHeight * sizeof(float));
}

}  // namespace
}  // namespace relievo::pipeline
