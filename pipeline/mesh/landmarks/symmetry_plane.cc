// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/symmetry_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <numbers>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

using Eigen::Vector3d;

constexpr double kFar = 6;        // mm: a reflection further off than this says nothing more
constexpr double kMissing = 2.5;  // mm: cost of a reflection beside the surface; keeps the halves overlapping
constexpr double kCellMm = 2.5;
constexpr double kScale = 1.5;  // mm: asymmetry of a usual face; the robust weight halves about here

// Means of a surface over square cells of its own x-y plane, seen along z.
class HeightMap {
 public:
  HeightMap(std::span<const SurfacePoint> points, std::pmr::memory_resource* memory)
      : cells_(memory), count_(memory) {
    double right = -1e9;
    double top = -1e9;
    left_mm_ = bottom_mm_ = 1e9;
    for (const SurfacePoint& p : points) {
      left_mm_ = std::min(left_mm_, p.at_mm.x());
      right = std::max(right, p.at_mm.x());
      bottom_mm_ = std::min(bottom_mm_, p.at_mm.y());
      top = std::max(top, p.at_mm.y());
    }
    if (points.empty() || right - left_mm_ > 5000 || top - bottom_mm_ > 5000) return;
    columns_ = int((right - left_mm_) / kCellMm) + 1;
    rows_ = int((top - bottom_mm_) / kCellMm) + 1;
    const std::size_t n = std::size_t(columns_) * std::size_t(rows_);
    cells_.assign(n, SurfacePoint{});
    count_.assign(n, 0U);
    for (const SurfacePoint& p : points) {
      const auto c = std::size_t((p.at_mm.x() - left_mm_) / kCellMm);
      const auto r = std::size_t((p.at_mm.y() - bottom_mm_) / kCellMm);
      const std::size_t k = r * std::size_t(columns_) + c;
      cells_[k].at_mm += p.at_mm;
      cells_[k].normal += p.normal;
      ++count_[k];
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (count_[k] == 0) continue;
      cells_[k].at_mm /= double(count_[k]);
      cells_[k].normal.normalize();
    }
  }

  // The cell's mean point below or above (x, y); null where the surface has none.
  const SurfacePoint* at(double x_mm, double y_mm) const {
    const double c = std::floor((x_mm - left_mm_) / kCellMm);
    const double r = std::floor((y_mm - bottom_mm_) / kCellMm);
    if (!(c >= 0 && r >= 0 && c < columns_ && r < rows_)) return nullptr;
    const std::size_t k = std::size_t(r) * std::size_t(columns_) + std::size_t(c);
    return count_[k] == 0 ? nullptr : &cells_[k];
  }

 private:
  double left_mm_ = 0, bottom_mm_ = 0;
  int columns_ = 0, rows_ = 0;
  std::pmr::vector<SurfacePoint> cells_;
  std::pmr::vector<std::uint32_t> count_;
};

// Yaw about y, roll about z, offset along the normal.
using Pose = Vector3d;

Vector3d normal_of(const Pose& pose) {
  return {std::cos(pose[0]) * std::cos(pose[1]), std::sin(pose[1]), -std::sin(pose[0]) * std::cos(pose[1])};
}

struct Residual {
  double distance;
  bool met;
};

Residual residual(const HeightMap& map, const SurfacePoint& p, const Vector3d& normal, double offset) {
  const Vector3d mirrored = p.at_mm - 2 * (normal.dot(p.at_mm) - offset) * normal;
  const SurfacePoint* other = map.at(mirrored.x(), mirrored.y());
  if (other == nullptr) return {0, false};
  const Vector3d turned = p.normal - 2 * normal.dot(p.normal) * normal;
  if (turned.dot(other->normal) < 0.5) return {kFar, true};
  return {other->normal.dot(mirrored - other->at_mm), true};
}

double cost(const HeightMap& map, std::span<const SurfacePoint> points, std::size_t every, const Pose& pose) {
  const Vector3d normal = normal_of(pose);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); i += every) {
    const Residual r = residual(map, points[i], normal, pose[2]);
    sum += r.met ? std::min(std::abs(r.distance), kFar) : kMissing;
  }
  return sum;
}

// Gauss-Newton with Geman-McClure weights; derivatives by differences, as the map is in steps anyway.
Pose descend(const HeightMap& map, std::span<const SurfacePoint> points, Pose pose) {
  const Vector3d step{0.01, 0.01, 0.5};
  for (int turn = 0; turn < 20; ++turn) {
    std::array<Vector3d, 3> ahead;
    std::array<double, 3> offset{pose[2], pose[2], pose[2] + step[2]};
    for (int k = 0; k < 3; ++k) {
      Pose moved = pose;
      moved[k] += step[k];
      ahead[std::size_t(k)] = normal_of(moved);
    }
    const Vector3d normal = normal_of(pose);
    Eigen::Matrix3d a = Eigen::Matrix3d::Identity() * 1e-9;
    Vector3d b = Vector3d::Zero();
    for (const SurfacePoint& p : points) {
      const Vector3d mirrored = p.at_mm - 2 * (normal.dot(p.at_mm) - pose[2]) * normal;
      const SurfacePoint* other = map.at(mirrored.x(), mirrored.y());
      if (other == nullptr) continue;
      const double r = other->normal.dot(mirrored - other->at_mm);
      if (std::abs(r) > 2 * kFar) continue;
      Vector3d slope;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d moved = p.at_mm - 2 * (ahead[k].dot(p.at_mm) - offset[k]) * ahead[k];
        slope[static_cast<Eigen::Index>(k)] =
            other->normal.dot(moved - mirrored) / step[static_cast<Eigen::Index>(k)];
      }
      const double w = 1 / ((1 + r * r / (kScale * kScale)) * (1 + r * r / (kScale * kScale)));
      a += w * slope * slope.transpose();
      b -= w * r * slope;
    }
    const Vector3d change = solved<3>(a, b);
    if (!change.allFinite()) break;
    pose += change;
    if (std::abs(change[0]) + std::abs(change[1]) < 1e-5 && std::abs(change[2]) < 1e-3) break;
  }
  return pose;
}

struct Start {
  double cost;
  Pose pose;
};

// The best of a coarse raster; three of them, as a face a quarter turned has false optima.
std::array<Start, 3> raster(const HeightMap& map, std::span<const SurfacePoint> points, ThreadPool& pool) {
  constexpr int kYaws = 9, kRolls = 5, kOffsets = 5;
  constexpr double kDeg = std::numbers::pi / 180;
  std::array<Start, kYaws * kRolls * kOffsets> starts;
  const std::size_t every = std::max<std::size_t>(1, points.size() / 500);
  pool.for_each(int(starts.size()), kYaws, [&](int k) {
    const int yaw = k / (kRolls * kOffsets), roll = k / kOffsets % kRolls, offset = k % kOffsets;
    const Pose pose{(10 * yaw - 40) * kDeg, (8 * roll - 16) * kDeg, 4.0 * offset - 8};
    starts[std::size_t(k)] = {cost(map, points, every, pose), pose};
  });
  std::array<Start, 3> best;
  std::partial_sort_copy(starts.begin(), starts.end(), best.begin(), best.end(),
                         [](const Start& l, const Start& r) { return l.cost < r.cost; });
  return best;
}

}  // namespace

Result<SymmetryPlane> find_symmetry_plane(std::span<const SurfacePoint> points, StageContext& context) {
  const HeightMap map(points, &context.scratch);
  std::array<Start, 3> ends = raster(map, points, context.pool);
  if (context.stop()) return stopped();
  context.pool.for_each(int(ends.size()), int(ends.size()), [&](int k) {
    Start& end = ends[std::size_t(k)];
    const Pose pose = descend(map, points, end.pose);
    // On a rough surface the descent may leave for where hardly anything meets: a
    // start that was better stays.
    end.cost = cost(map, points, 1, end.pose);
    if (const double c = cost(map, points, 1, pose); c < end.cost) end = {c, pose};
  });
  const Start& best =
      *std::ranges::min_element(ends, [](const Start& l, const Start& r) { return l.cost < r.cost; });
  SymmetryPlane plane;
  plane.normal = normal_of(best.pose);
  plane.offset_mm = best.pose[2];
  plane.cost_mm = best.cost / double(std::max<std::size_t>(1, points.size()));
  std::pmr::vector<double> distances(&context.scratch);
  distances.reserve(points.size());
  for (const SurfacePoint& p : points)
    if (const Residual r = residual(map, p, plane.normal, plane.offset_mm); r.met)
      distances.push_back(std::abs(r.distance));
  const double overlap = double(distances.size()) / double(std::max<std::size_t>(1, points.size()));
  if (distances.size() < 100 || overlap < 0.2 || plane.normal.x() < 0.3 || std::abs(plane.offset_mm) > 20)
    return Error{Errc::PoorGeometry, "the surface has no plane of symmetry: it shows less than half a face"};
  plane.residual_mm = median(distances);
  return plane;
}

SymmetryPlane settle_symmetry_plane(std::span<const SurfacePoint> points, Arena& scratch) {
  const Arena::Mark mark(scratch);
  const Pose pose = descend(HeightMap(points, &scratch), points, Pose::Zero());
  SymmetryPlane plane;
  plane.normal = normal_of(pose);
  plane.offset_mm = pose[2];
  return plane;
}

}  // namespace relievo::pipeline
