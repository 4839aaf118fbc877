// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/bending/bending_system.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include <Eigen/Dense>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kLatticeWidth = 27,
              kLatticeHeight = 22;  // odd and even: the lattices above have a border on either side

bool known(int x, int y) {
  return x >= 2 && y >= 1 && x < kLatticeWidth - 1 && y < kLatticeHeight - 2 &&
         (x < 9 || x > 11 || y < 6 || y > 9);
}

void fill(BendingSystem& s) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0.1F, 1);
  for (int y = 0; y < kLatticeHeight; ++y)
    for (int x = 0; x < kLatticeWidth; ++x) {
      if (!known(x, y)) continue;
      s.data.row(y)[x] = 0.01F * unit(random);
      if (known(x - 1, y) && known(x + 1, y)) s.bend_xx.row(y)[x] = unit(random);
      if (known(x, y - 1) && known(x, y + 1)) s.bend_yy.row(y)[x] = unit(random);
      if (known(x + 1, y) && known(x, y + 1) && known(x + 1, y + 1)) s.bend_xy.row(y)[x] = unit(random);
    }
}

// The operator, column by column.
Eigen::MatrixXd dense(MultilevelPreconditioner& preconditioner, test::StageFixture& fixture) {
  const std::pmr::vector<ColumnSpan> whole(kLatticeHeight, ColumnSpan{0, kLatticeWidth});
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(kLatticeWidth * kLatticeHeight, kLatticeWidth * kLatticeHeight);
  for (int k = 0; k < kLatticeWidth * kLatticeHeight; ++k) {
    Arena::Mark mark(fixture.scratch);
    Plane<float> r(&fixture.scratch, kLatticeWidth, kLatticeHeight);
    Plane<float> z(&fixture.scratch, kLatticeWidth, kLatticeHeight);
    if (!known(k % kLatticeWidth, k / kLatticeWidth)) continue;
    r.values[static_cast<std::size_t>(k)] = 1;
    preconditioner.apply(r, whole, z);
    for (int i = 0; i < kLatticeWidth * kLatticeHeight; ++i)
      m(i, k) = static_cast<double>(z.values[static_cast<std::size_t>(i)]);
  }
  return m;
}

// Conjugate gradients converge with no other kind.
TEST(MultilevelPreconditioner, IsSymmetricPositiveAndKeepsToTheKnownNodes) {
  test::StageFixture fixture(1 << 20, 1 << 22);
  BendingSystem s(&fixture.scratch, kLatticeWidth, kLatticeHeight);
  fill(s);
  MultilevelPreconditioner preconditioner(s, fixture.pool, &fixture.scratch);
  const Eigen::MatrixXd m = dense(preconditioner, fixture);
  EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-4 * m.cwiseAbs().maxCoeff());
  for (int k = 0; k < kLatticeWidth * kLatticeHeight; ++k)
    EXPECT_EQ(m(k, k) > 0, known(k % kLatticeWidth, k / kLatticeWidth))
        << k % kLatticeWidth << ", " << k / kLatticeWidth;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((m + m.transpose()) / 2).eigenvalues();
  int positive = 0;
  for (const double value : values) positive += value > 1e-4;
  int nodes = 0;
  for (int k = 0; k < kLatticeWidth * kLatticeHeight; ++k)
    nodes += known(k % kLatticeWidth, k / kLatticeWidth);
  EXPECT_EQ(positive, nodes);
  EXPECT_GT(values.minCoeff(), -1e-5);
}

// What one node says reaches one that is ten nodes away: the diagonal alone would leave 0 there.
TEST(MultilevelPreconditioner, CarriesFar) {
  test::StageFixture fixture(1 << 20, 1 << 22);
  BendingSystem s(&fixture.scratch, kLatticeWidth, kLatticeHeight);
  fill(s);
  MultilevelPreconditioner preconditioner(s, fixture.pool, &fixture.scratch);
  const std::pmr::vector<ColumnSpan> whole(kLatticeHeight, ColumnSpan{0, kLatticeWidth});
  Plane<float> r(&fixture.scratch, kLatticeWidth, kLatticeHeight);
  Plane<float> z(&fixture.scratch, kLatticeWidth, kLatticeHeight);
  r.row(15)[5] = 1;
  preconditioner.apply(r, whole, z);
  EXPECT_GT(z.row(15)[15], 0);
}

TEST(MultilevelPreconditioner, IsTheSameWhateverTheThreads) {
  std::vector<float> found[2];
  for (const int threads : {1, 4}) {
    test::StageFixture fixture(1 << 20, 1 << 20, threads);
    BendingSystem s(&fixture.scratch, kLatticeWidth, kLatticeHeight);
    fill(s);
    MultilevelPreconditioner preconditioner(s, fixture.pool, &fixture.scratch);
    Plane<float> z(&fixture.scratch, kLatticeWidth, kLatticeHeight);
    preconditioner.apply(s.data, std::pmr::vector<ColumnSpan>(kLatticeHeight, ColumnSpan{0, kLatticeWidth}),
                         z);
    found[threads == 1 ? 0 : 1].assign(z.values.begin(), z.values.end());
  }
  EXPECT_EQ(found[0], found[1]);
}

// Four and a third while it is made, and a tenth for the lattices' borders.
TEST(MultilevelPreconditioner, TakesThePlanesItSays) {
  constexpr int kWide = 400, kHigh = 300;
  test::StageFixture fixture(4 << 20, 4 << 20);
  const BendingSystem system(&fixture.output, kWide, kHigh);
  const MultilevelPreconditioner preconditioner(system, fixture.pool, &fixture.scratch);
  EXPECT_LT(static_cast<double>(fixture.scratch.used()), 1.1 * 13 / 3 * kWide * kHigh * sizeof(float));
}

}  // namespace
}  // namespace relievo::pipeline
