// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/relief/height_cells.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/base/statistics.h"

namespace relievo::pipeline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMiddleShare = 0.15;  // of the face's width: surface that is surely in its middle
constexpr std::size_t kEnough = 50;
constexpr double kPlaneBendMm = 3;  // what lies further off the plane pulls no harder
constexpr int kPlaneRounds = 8;
constexpr double kMostParts = 40;  // of an edge

struct Sample {
  Vector3d at;  // rectified frame
  double sigma_mm;
};
using Samples = std::pmr::vector<Sample>;

Samples measured_of(const FaceMesh& mesh, const RectifiedPair& pair, std::pmr::memory_resource* memory) {
  Samples all(memory);
  all.reserve(mesh.vertices_mm.size());
  for (std::size_t k = 0; k < mesh.vertices_mm.size(); ++k) {
    if (mesh.measured[k] == 0) continue;
    const Vec3f& v = mesh.vertices_mm[k];
    const Vec3d p = apply(pair.rectified_from_left, Vec3d{v.x, v.y, v.z});
    if (p.z > 0) all.push_back({{p.x, p.y, p.z}, static_cast<double>(mesh.sigma_mm[k])});
  }
  return all;
}

// Of triangles wider than a cell also places in between: where points are scattered, what spans them is the
// surface that was measured.
void add_between(Samples& all, const FaceMesh& mesh, const RectifiedPair& pair, double cell_mm) {
  for (const auto& t : mesh.triangles) {
    if (mesh.measured[t[0]] == 0 || mesh.measured[t[1]] == 0 || mesh.measured[t[2]] == 0) continue;
    std::array<Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f& v = mesh.vertices_mm[t[k]];
      const Vec3d p = apply(pair.rectified_from_left, Vec3d{v.x, v.y, v.z});
      corner[k] = {p.x, p.y, p.z};
    }
    const double longest = std::max(
        {(corner[0] - corner[1]).norm(), (corner[1] - corner[2]).norm(), (corner[2] - corner[0]).norm()});
    const int parts = static_cast<int>(std::min(kMostParts, 2 * longest / cell_mm));
    const double sigma =
        static_cast<double>(std::max({mesh.sigma_mm[t[0]], mesh.sigma_mm[t[1]], mesh.sigma_mm[t[2]]}));
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        if (i == parts || j == parts || i + j == 0) continue;  // a corner: it is there
        const double a = static_cast<double>(i) / parts, b = static_cast<double>(j) / parts;
        all.push_back({a * corner[0] + b * corner[1] + (1 - a - b) * corner[2], sigma});
      }
  }
}

// Where the face's middle is in space: on the line of sight through it, as deep as the surface around.
// Where no face was looked for, the middle of the surface itself.
Vector3d middle_of(const Samples& all, const RectifiedPair& pair, std::pmr::memory_resource* memory) {
  std::pmr::vector<double> x(memory), y(memory), z(memory);
  x.reserve(all.size()), y.reserve(all.size()), z.reserve(all.size());
  double reach = kMiddleShare * pair.face_width_px / 2;
  while (z.size() < std::min(kEnough, all.size())) {
    reach *= 2;
    x.clear(), y.clear(), z.clear();
    for (const Sample& s : all) {
      const double u = pair.left_centre_px.x + pair.focal_px * s.at.x() / s.at.z() - pair.face_centre_px.x;
      const double v = pair.left_centre_px.y + pair.focal_px * s.at.y() / s.at.z() - pair.face_centre_px.y;
      if (pair.face_width_px > 0 && std::hypot(u, v) > reach) continue;
      x.push_back(s.at.x()), y.push_back(s.at.y()), z.push_back(s.at.z());
    }
  }
  const double depth = median(z);
  if (!(pair.face_width_px > 0)) return {median(x), median(y), depth};
  return {(pair.face_centre_px.x - pair.left_centre_px.x) / pair.focal_px * depth,
          (pair.face_centre_px.y - pair.left_centre_px.y) / pair.focal_px * depth, depth};
}

// Rows: x, y and height of the frame on the robust mean plane (Huber's weights; heights point back to the
// cameras).
struct PlaneFrame {
  Vector3d origin = Vector3d::Zero();
  Matrix3d axes = Matrix3d::Identity();
};

PlaneFrame plane_of(const Samples& all, const Vector3d& middle, double radius_mm) {
  PlaneFrame frame;
  Vector3d normal(0, 0, -1);
  frame.origin = middle;
  for (int round = 0; round < kPlaneRounds; ++round) {
    double weights = 0;
    Vector3d mean = Vector3d::Zero();
    Matrix3d spread = Matrix3d::Zero();
    for (const Sample& s : all) {
      if ((s.at - middle).norm() > radius_mm) continue;
      const double off = std::abs(normal.dot(s.at - frame.origin));
      const double w = round == 0 || off < kPlaneBendMm ? 1 : kPlaneBendMm / off;
      const Vector3d p = s.at - middle;
      weights += w;
      mean += w * p;
      spread += w * p * p.transpose();
    }
    if (!(weights > 0)) return frame;
    mean /= weights;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solved(spread / weights - mean * mean.transpose());
    normal = solved.eigenvectors().col(0);
    if (normal.z() > 0) normal = -normal;
    frame.origin = middle + mean;
  }
  const Vector3d across = Vector3d::UnitX() - normal.x() * normal;
  frame.axes.row(2) = normal;
  frame.axes.row(0) = across.norm() > 1e-3 ? across.normalized() : normal.unitOrthogonal();
  frame.axes.row(1) = frame.axes.row(0).cross(frame.axes.row(2));
  return frame;
}

struct Sum {
  double x = 0, y = 0, height = 0, sigma = 0;
  int count = 0;
};

}  // namespace

HeightCells make_height_cells(const FaceMesh& mesh, const RectifiedPair& pair, double radius_mm,
                              double cell_mm, StageContext& context) {
  HeightCells out(&context.scratch);
  out.cell_mm = cell_mm;
  out.side = 2 * static_cast<int>(std::ceil(radius_mm / cell_mm)) + 1;
  Samples all = measured_of(mesh, pair, &context.scratch);
  add_between(all, mesh, pair, cell_mm);
  if (all.size() < kEnough) return out;
  const Vector3d middle = middle_of(all, pair, &context.scratch);
  const PlaneFrame frame = plane_of(all, middle, radius_mm);

  const int half = out.side / 2;
  std::pmr::vector<Sum> sums(static_cast<std::size_t>(out.side * out.side), Sum{}, &context.scratch);
  for (const Sample& s : all) {
    if ((s.at - middle).norm() > radius_mm) continue;
    const Vector3d p = frame.axes * (s.at - frame.origin);
    const auto column = static_cast<int>(std::lround(p.x() / cell_mm)) + half,
               row = static_cast<int>(std::lround(p.y() / cell_mm)) + half;
    if (column < 0 || row < 0 || column >= out.side || row >= out.side) continue;
    Sum& sum = sums[static_cast<std::size_t>(row * out.side + column)];
    sum.x += p.x(), sum.y += p.y(), sum.height += p.z(), sum.sigma += s.sigma_mm;
    ++sum.count;
  }
  out.cells.reserve(sums.size());
  for (int row = 0; row < out.side; ++row)
    for (int column = 0; column < out.side; ++column) {
      const Sum& sum = sums[static_cast<std::size_t>(row * out.side + column)];
      if (sum.count > 0)
        out.cells.push_back({column, row, sum.x / sum.count, sum.y / sum.count, sum.height / sum.count,
                             sum.sigma / sum.count});
    }
  const double disc = 3.14159265358979323846 * (radius_mm / cell_mm) * (radius_mm / cell_mm);
  out.covered = static_cast<double>(out.cells.size()) / disc;
  return out;
}

}  // namespace relievo::pipeline
