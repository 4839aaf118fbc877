// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
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
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
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
      : samples_(samples),
        options_(options),
        context_(context),
        centres_(&context.scratch),
        chosen_(samples.u.size(), 0, &context.scratch),
        weights_(&context.scratch),
        matrix_(&context.scratch) {
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

  void depths(std::span<const double> us, double v, std::span<double> depths) const {
    for (std::size_t i = 0; i < us.size(); ++i) depths[i] = at(us[i], v);
  }

 private:
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
    context_.pool.for_each_band(int(n), kBands, [&](int from, int to, int) {
      for (int k = from; k < to; ++k) {
        const std::size_t i = std::size_t(k) * samples_.u.size() / n;
        const double off = std::abs(at(samples_.u[i], samples_.v[i]) - samples_.depth[i]);
        judged[std::size_t(k)] = {std::max(off - options_.smoothing * samples_.sigma[i], 0.0),
                                  std::uint32_t(i)};
      }
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
  std::pmr::vector<std::uint32_t> centres_;
  std::pmr::vector<std::uint8_t> chosen_;
  std::pmr::vector<double> weights_;  // of the centres, then of 1, x, y
  std::pmr::vector<double> matrix_;
  double middle_ = 0, scale_ = 1;
};

}  // namespace

Result<FaceMesh> RbfMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const DepthSamples samples = sample_depths(base, &context.scratch);
  Rbf function(samples, *this, context);
  if (!function.fit()) return Error{Errc::Cancelled, "meshing was stopped"};
  return mesh_sheet(
      base, samples, [&function](auto us, double v, auto depths) { function.depths(us, v, depths); }, sheet,
      context);
}

}  // namespace relievo::pipeline
