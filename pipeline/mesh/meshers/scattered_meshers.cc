// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/scattered_meshers.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <span>

#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kLeastSigmaMm = 0.005F;
constexpr float kBetweenShare = 0.05F;  // of a measured point's weight, where there is none near
constexpr float kSparse = 1.5F;         // voxels: points further apart are joined by others

// Those of a sheet, by their certainty.
void add_points(const FaceMesh& sheet, float share, std::pmr::vector<FieldPoint>& points) {
  for (std::size_t i = 0; i < sheet.vertices_mm.size(); ++i) {
    const float sigma = std::max(sheet.sigma_mm[i], kLeastSigmaMm);
    points.push_back(
        {sheet.vertices_mm[i], sheet.normals[i], share * kLeastSigmaMm * kLeastSigmaMm / (sigma * sigma)});
  }
}

}  // namespace

Result<FaceMesh> MarchingCubesMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  // Points wide apart would leave holes between their balls: the voxels follow.
  const float voxel =
      std::max(float(voxel_mm), 0.6F * usual_edge_mm(base.vertices_mm, base.triangles, &context.scratch));
  const float radius = float(band_voxels) * voxel;
  BandVolume volume = volume_around(base.vertices_mm, voxel, int(band_voxels) + 2, &context.scratch);
  const FaceMesh between = densify(base, kSparse * voxel, &context.scratch);
  std::pmr::vector<FieldPoint> points(&context.scratch);
  points.reserve(base.vertices_mm.size() + between.vertices_mm.size());
  add_points(base, 1, points);
  add_points(between, kBetweenShare, points);
  fill_field(points, radius, volume, context);
  if (context.stop()) return stopped();
  Polygonised surface = polygonise(volume, &context.scratch);
  return finish_surface(base, surface.vertices_mm, surface.triangles, finish, context);
}

namespace {

constexpr int kBands = 64;
constexpr int kFirstCentres = 150;
constexpr double kGrowth = 2;            // centres from turn to turn
constexpr std::size_t kJudged = 20'000;  // points the function is compared with, spread evenly

// r^2 log r of a squared distance.
double plate(double square) { return square > 0 ? 0.5 * square * std::log(square) : 0; }

class Rbf {
 public:
  Rbf(const DepthSamples& samples, const RbfMesher& options, StageContext& context)
      : samples_(samples), options_(options), context_(context) {
    const std::size_t most = std::min(std::size_t(options.max_centres), samples.u.size());
    const std::size_t side = most + 3;
    centres_.reserve(most);
    weights_.reserve(side);
    matrix_.assign(side * side, 0.0);
    middle_ = samples.usual_depth_mm;
    scale_ = 0.5 * std::max({samples.right - samples.left, samples.bottom - samples.top, 1.0});
  }

  // False where it was stopped.
  bool fit() {
    const std::size_t most = centres_.capacity();
    const std::size_t first = std::min(most, std::size_t(kFirstCentres));
    for (std::size_t i = 0; i < first; ++i) choose(i * samples_.u.size() / first);
    solve();
    while (centres_.size() < most) {
      if (context_.stop()) return false;
      const std::size_t wanted =
          std::min(most - centres_.size(), std::size_t((kGrowth - 1) * double(centres_.size())));
      if (add_worst(wanted) == 0) break;
      solve();
    }
    return !context_.stop();
  }

  double at(double u, double v) const {
    const std::size_t n = centres_.size();
    const double x = u / scale_, y = v / scale_;
    double sum = weights_[n] + weights_[n + 1] * x + weights_[n + 2] * y;
    for (std::size_t i = 0; i < n; ++i) {
      const double dx = x - samples_.u[centres_[i]] / scale_;
      const double dy = y - samples_.v[centres_[i]] / scale_;
      sum += weights_[i] * plate(dx * dx + dy * dy);
    }
    return middle_ + sum;
  }

 private:
  void choose(std::size_t i) {
    if (chosen_[i]) return;
    chosen_[i] = 1;
    centres_.push_back(std::uint32_t(i));
  }

  // (A + smoothing sigma^2 I) w + P c = d, P' w = 0, in place.
  void solve() {
    const Eigen::Index n = static_cast<Eigen::Index>(centres_.size());
    Eigen::Map<Eigen::MatrixXd> a(matrix_.data(), n + 3, n + 3);
    weights_.assign(centres_.size() + 3, 0.0);
    Eigen::Map<Eigen::VectorXd> d(weights_.data(), n + 3);
    a.setZero();
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t p = centres_[std::size_t(i)];
      const double x = samples_.u[p] / scale_, y = samples_.v[p] / scale_;
      for (Eigen::Index j = 0; j < i; ++j) {
        const std::size_t q = centres_[std::size_t(j)];
        const double dx = x - samples_.u[q] / scale_, dy = y - samples_.v[q] / scale_;
        a(i, j) = a(j, i) = plate(dx * dx + dy * dy);
      }
      // Per mm^2 of scale: the plate's bending is measured there.
      a(i, i) = options_.smoothing * samples_.sigma[p] * samples_.sigma[p] / (scale_ * scale_);
      a(i, n) = a(n, i) = 1;
      a(i, n + 1) = a(n + 1, i) = x;
      a(i, n + 2) = a(n + 2, i) = y;
      d(i) = samples_.depth[p] - middle_;
    }
    Eigen::Ref<Eigen::MatrixXd> in_place(a);
    const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> lu(in_place);
    const Eigen::VectorXd solved = lu.solve(d);
    d = solved;
  }

  struct Judged {
    double off;
    std::uint32_t point;
    friend bool operator<(const Judged& a, const Judged& b) {
      return a.off != b.off ? a.off > b.off : a.point < b.point;
    }
  };

  // The worst points, but never two in one cell: cells get smaller as centres get more.
  std::size_t add_worst(std::size_t wanted) {
    const Arena::Mark turn(context_.scratch);
    const std::size_t n = std::min(kJudged, samples_.u.size());
    std::pmr::vector<Judged> judged(n, Judged{}, &context_.scratch);
    context_.pool.for_each(int(n), kBands, [&](int k) {
      const std::size_t i = std::size_t(k) * samples_.u.size() / n;
      const double off = std::abs(at(samples_.u[i], samples_.v[i]) - samples_.depth[i]);
      judged[std::size_t(k)] = {std::max(off - options_.smoothing * samples_.sigma[i], 0.0),
                                std::uint32_t(i)};
    });
    std::sort(judged.begin(), judged.end());
    const double area = (samples_.right - samples_.left) * (samples_.bottom - samples_.top);
    const double side = std::max(std::sqrt(area / double(2 * (centres_.size() + wanted))), 1e-3);
    const std::size_t columns = std::size_t((samples_.right - samples_.left) / side) + 1;
    const std::size_t rows = std::size_t((samples_.bottom - samples_.top) / side) + 1;
    std::pmr::vector<std::uint8_t> taken(columns * rows, 0, &context_.scratch);
    std::size_t added = 0;
    for (const Judged& j : judged) {
      if (added == wanted || j.off <= options_.accuracy_mm) break;
      const std::size_t cell = std::size_t((samples_.v[j.point] - samples_.top) / side) * columns +
                               std::size_t((samples_.u[j.point] - samples_.left) / side);
      if (taken[cell] || chosen_[j.point]) continue;
      taken[cell] = 1;
      choose(j.point);
      ++added;
    }
    return added;
  }

  const DepthSamples& samples_;
  const RbfMesher& options_;
  StageContext& context_;
  std::pmr::vector<std::uint32_t> centres_{&context_.scratch};
  std::pmr::vector<std::uint8_t> chosen_{samples_.u.size(), 0, &context_.scratch};
  std::pmr::vector<double> weights_{&context_.scratch};  // of the centres, then of 1, x, y
  std::pmr::vector<double> matrix_{&context_.scratch};
  double middle_ = 0, scale_ = 1;
};

}  // namespace

Result<FaceMesh> RbfMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const DepthSamples samples = sample_depths(base, &context.scratch);
  Rbf function(samples, *this, context);
  if (!function.fit()) return stopped();
  return mesh_sheet(
      base, samples, [&function](double u, double v) { return function.at(u, v); }, sheet, context);
}

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
      : columns_(columns), rows_(rows), memory_(memory) {}

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
  void solve(int most_turns, double enough, const StageContext& context) {
    residual_ = right_;
    step_.assign(size(), 0.0);
    product_.assign(size(), 0.0);
    double before = 0, first = 0;
    for (int turn = 0; turn < most_turns && !context.stop(); ++turn) {
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
  std::pmr::memory_resource* memory_;
  std::pmr::vector<double> ties_{size() * kSide * kSide, 0.0, memory_};
  std::pmr::vector<double> right_{size(), 0.0, memory_}, value_{size(), 0.0, memory_};
  std::pmr::vector<double> residual_{memory_}, step_{memory_}, product_{memory_};
};

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

BezierNet::BezierNet(const DepthSamples& samples, double patch_mm, double bending, StageContext& context)
    : left_(samples.left),
      top_(samples.top),
      side_(patch_mm),
      middle_(samples.usual_depth_mm),
      columns_(int((samples.right - samples.left) / patch_mm) + 1),
      rows_(int((samples.bottom - samples.top) / patch_mm) + 1),
      patches_(std::size_t(columns_) * std::size_t(rows_), Patch{}, &context.scratch) {
  Normal normal(columns_ + 3, rows_ + 3, &context.scratch);
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
  // Squared second differences of the coefficients, twice the mixed one: the thin plate's energy on the net.
  const int net_columns = columns_ + 3, net_rows = rows_ + 3;
  const double bend = bending * weights / double(normal.size());
  for (int r = 0; r < net_rows; ++r)
    for (int c = 0; c < net_columns; ++c) {
      if (c + 2 < net_columns)
        normal.add(std::array<Normal::Term, 3>{{{c, r, 1}, {c + 1, r, -2}, {c + 2, r, 1}}}, 0, bend);
      if (r + 2 < net_rows)
        normal.add(std::array<Normal::Term, 3>{{{c, r, 1}, {c, r + 1, -2}, {c, r + 2, 1}}}, 0, bend);
      if (c + 1 < net_columns && r + 1 < net_rows)
        normal.add(
            std::array<Normal::Term, 4>{{{c, r, 1}, {c + 1, r, -1}, {c, r + 1, -1}, {c + 1, r + 1, 1}}}, 0,
            2 * bend);
    }
  normal.solve(2000, 1e-14, context);
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

double BezierNet::depth(double u, double v) const {
  const Share x = share_of(u, left_, side_, columns_), y = share_of(v, top_, side_, rows_);
  const Patch& p = patch(x.whole, y.whole);
  Four down;
  for (std::size_t j = 0; j < 4; ++j) down[j] = de_casteljau(p[j], x.rest);
  return middle_ + de_casteljau(down, y.rest);
}

Result<FaceMesh> BezierMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const DepthSamples samples = sample_depths(base, &context.scratch);
  const BezierNet net(samples, patch_mm, bending, context);
  if (context.stop()) return stopped();
  return mesh_sheet(
      base, samples, [&net](double u, double v) { return net.depth(u, v); }, sheet, context);
}

}  // namespace relievo::pipeline
