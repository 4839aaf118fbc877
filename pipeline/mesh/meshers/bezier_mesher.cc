// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/scattered_meshers.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace relievo::pipeline {
namespace {

using Four = std::array<double, 4>;

// Uniform cubic B-splines at t in 0 .. 1 of a knot's interval.
Four basis(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
          t * t * t / 6};
}

// The Bezier values of the interval between the middle two of four coefficients (knot insertion).
Four bezier(const Four& c) {
  return {(c[0] + 4 * c[1] + c[2]) / 6, (2 * c[1] + c[2]) / 3, (c[1] + 2 * c[2]) / 3,
          (c[1] + 4 * c[2] + c[3]) / 6};
}

double de_casteljau(Four b, double t) {
  for (int level = 3; level > 0; --level)
    for (std::size_t i = 0; i < std::size_t(level); ++i) b[i] += t * (b[i + 1] - b[i]);
  return b[0];
}

// The normal equations of the coefficients: each is tied to those up to three away, 7 x 7 of them.
class Normal {
 public:
  static constexpr int kReach = 3, kSide = 7;

  Normal(int columns, int rows, std::pmr::memory_resource* memory)
      : columns_(columns),
        rows_(rows),
        ties_(size() * kSide * kSide, 0.0, memory),
        right_(size(), 0.0, memory),
        value_(size(), 0.0, memory),
        residual_(memory),
        step_(memory),
        product_(memory) {}

  std::size_t size() const { return std::size_t(columns_) * std::size_t(rows_); }
  std::size_t index(int c, int r) const { return std::size_t(r) * std::size_t(columns_) + std::size_t(c); }
  const std::pmr::vector<double>& solution() const { return value_; }

  struct Term {
    int c, r;
    double weight;
  };
  // weight * (sum of terms - aim)^2
  void add(std::span<const Term> terms, double aim, double weight) {
    for (const Term& a : terms) {
      right_[index(a.c, a.r)] += weight * a.weight * aim;
      double* row = &ties_[index(a.c, a.r) * kSide * kSide];
      for (const Term& b : terms)
        row[(b.r - a.r + kReach) * kSide + b.c - a.c + kReach] += weight * a.weight * b.weight;
    }
  }

  // Conjugate gradients, scaled by the diagonal.
  void solve(int most_turns, double enough) {
    residual_ = right_;
    step_.assign(size(), 0.0);
    product_.assign(size(), 0.0);
    double before = 0, first = 0;
    for (int turn = 0; turn < most_turns; ++turn) {
      double now = 0;
      for (std::size_t i = 0; i < size(); ++i) now += residual_[i] * residual_[i] / diagonal(i);
      if (turn == 0) first = now;
      if (!(now > enough * first)) return;
      for (std::size_t i = 0; i < size(); ++i)
        step_[i] = residual_[i] / diagonal(i) + (turn > 0 ? now / before * step_[i] : 0);
      multiply();
      double along = 0;
      for (std::size_t i = 0; i < size(); ++i) along += step_[i] * product_[i];
      const double length = now / along;
      if (!std::isfinite(length)) return;
      for (std::size_t i = 0; i < size(); ++i) {
        value_[i] += length * step_[i];
        residual_[i] -= length * product_[i];
      }
      before = now;
    }
  }

 private:
  double diagonal(std::size_t i) const { return ties_[i * kSide * kSide + kSide * kReach + kReach]; }

  void multiply() {
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        const double* row = &ties_[index(c, r) * kSide * kSide];
        double sum = 0;
        for (int dr = std::max(-kReach, -r); dr <= std::min(kReach, rows_ - 1 - r); ++dr)
          for (int dc = std::max(-kReach, -c); dc <= std::min(kReach, columns_ - 1 - c); ++dc)
            sum += row[(dr + kReach) * kSide + dc + kReach] * step_[index(c + dc, r + dr)];
        product_[index(c, r)] = sum;
      }
  }

  int columns_, rows_;
  std::pmr::vector<double> ties_, right_, value_, residual_, step_, product_;
};

// Squared second differences of the coefficients, twice the mixed one: the thin plate's energy on the net.
void add_bending(Normal& normal, int columns, int rows, double weight) {
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      if (c + 2 < columns)
        normal.add(std::array<Normal::Term, 3>{{{c, r, 1}, {c + 1, r, -2}, {c + 2, r, 1}}}, 0, weight);
      if (r + 2 < rows)
        normal.add(std::array<Normal::Term, 3>{{{c, r, 1}, {c, r + 1, -2}, {c, r + 2, 1}}}, 0, weight);
      if (c + 1 < columns && r + 1 < rows)
        normal.add(
            std::array<Normal::Term, 4>{{{c, r, 1}, {c + 1, r, -1}, {c, r + 1, -1}, {c + 1, r + 1, 1}}}, 0,
            2 * weight);
    }
}

struct Share {
  int whole;
  double rest;
};
Share share_of(double at, double from, double side, int count) {
  const double units = (at - from) / side;
  const int whole = std::clamp(int(std::floor(units)), 0, count - 1);
  return {whole, units - whole};
}

}  // namespace

BezierNet::BezierNet(const DepthSamples& samples, double patch_mm, double bending,
                     std::pmr::memory_resource* memory)
    : left_(samples.left),
      top_(samples.top),
      side_(patch_mm),
      middle_(samples.usual_depth_mm),
      columns_(int((samples.right - samples.left) / patch_mm) + 1),
      rows_(int((samples.bottom - samples.top) / patch_mm) + 1),
      patches_(std::size_t(columns_) * std::size_t(rows_), Patch{}, memory) {
  Normal normal(columns_ + 3, rows_ + 3, memory);
  double weights = 0;
  for (std::size_t i = 0; i < samples.u.size(); ++i) {
    const Share u = share_of(samples.u[i], left_, side_, columns_),
                v = share_of(samples.v[i], top_, side_, rows_);
    const Four across = basis(u.rest), down = basis(v.rest);
    std::array<Normal::Term, 16> terms;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        terms[std::size_t(4 * r + c)] = {u.whole + c, v.whole + r,
                                         down[std::size_t(r)] * across[std::size_t(c)]};
    const double weight = 1 / std::max(samples.sigma[i] * samples.sigma[i], 1e-6);
    normal.add(terms, samples.depth[i] - middle_, weight);
    weights += weight;
  }
  add_bending(normal, columns_ + 3, rows_ + 3, bending * weights / double(normal.size()));
  normal.solve(2000, 1e-14);
  const std::pmr::vector<double>& coefficient = normal.solution();
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c) {
      Patch& patch = patches_[std::size_t(r * columns_ + c)];
      for (int j = 0; j < 4; ++j) {
        const double* line = &coefficient[normal.index(c, r + j)];
        patch[std::size_t(j)] = bezier({line[0], line[1], line[2], line[3]});
      }
      for (std::size_t i = 0; i < 4; ++i) {
        const Four down = bezier({patch[0][i], patch[1][i], patch[2][i], patch[3][i]});
        for (std::size_t j = 0; j < 4; ++j) patch[j][i] = down[j];
      }
    }
}

void BezierNet::depths(std::span<const double> us, double v, std::span<double> depths) const {
  const Share y = share_of(v, top_, side_, rows_);
  for (std::size_t i = 0; i < us.size(); ++i) {
    const Share x = share_of(us[i], left_, side_, columns_);
    const Patch& p = patch(x.whole, y.whole);
    Four down;
    for (std::size_t j = 0; j < 4; ++j) down[j] = de_casteljau(p[j], x.rest);
    depths[i] = middle_ + de_casteljau(down, y.rest);
  }
}

Result<FaceMesh> BezierMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const DepthSamples samples = sample_depths(base, &context.scratch);
  const BezierNet net(samples, patch_mm, bending, &context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  return mesh_sheet(
      base, samples, [&net](auto us, double v, auto depths) { net.depths(us, v, depths); }, sheet, context);
}

}  // namespace relievo::pipeline
