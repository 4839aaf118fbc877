// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/best_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "pipeline/base/solving.h"

namespace relievo::pipeline::best_fit {
namespace {

constexpr std::size_t kFewest = 20;

const Error kTooFew{Errc::PoorGeometry, "too few points for a best fit: the target was hardly seen"};
const Error kShapeless{Errc::PoorGeometry,
                       "these points determine no sphere or plane: they do not lie on one surface"};

// Normal equations of four unknowns. False where the points leave one of them open.
struct Normal4 {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();

  void add(const Eigen::Vector4d& row, double value) {
    a += row * row.transpose();
    b += value * row;
  }
  bool solve(Eigen::Vector4d& x) const {
    const Eigen::LDLT<Eigen::Matrix4d> factor(a);
    x = factor.solve(b);
    return factor.vectorD().minCoeff() > 1e-12 * a.diagonal().maxCoeff();
  }
};

Vec3d middle_of(const std::vector<Vec3d>& points) {
  Vec3d middle;
  for (const Vec3d& p : points) middle = plus(middle, p);
  return times(middle, 1 / double(points.size()));
}

// |p|^2 = 2 c.p + k: linear in the centre. Biased by noise, but a start.
Result<Sphere> guess_sphere(const std::vector<Vec3d>& points, const Vec3d& middle) {
  double size = 0;
  for (const Vec3d& p : points) size = std::max(size, distance(p, middle));
  if (!(size > 0)) return kShapeless;
  Normal4 system;
  for (const Vec3d& point : points) {
    const Vec3d p = times(minus(point, middle), 1 / size);
    system.add({p.x, p.y, p.z, 1}, dot(p, p));
  }
  Eigen::Vector4d x;
  if (!system.solve(x)) return kShapeless;
  const Vec3d centre{x[0] / 2, x[1] / 2, x[2] / 2};
  return Sphere{plus(middle, times(centre, size)),
                size * std::sqrt(std::max(0.0, x[3] + dot(centre, centre)))};
}

template <typename Form>
FormReading<Form> judge(const Form& form, const std::vector<Vec3d>& points) {
  FormReading<Form> reading{form};
  double low = 1e300, high = -1e300, squares = 0;
  for (const Vec3d& p : points) {
    const double d = deviation(form, p);
    low = std::min(low, d);
    high = std::max(high, d);
    squares += d * d;
  }
  reading.range_mm = high - low;
  reading.rms_mm = std::sqrt(squares / double(points.size()));
  reading.used = points.size();
  return reading;
}

// A fit to all says which points are furthest off; a fit to the rest is the reading.
template <typename Form, typename Fit>
Result<FormReading<Form>> read_form(const std::vector<Vec3d>& points, double discard_share, Fit fit) {
  RELIEVO_TRY_ASSIGN(const Form first, fit(points));
  const auto discarded = std::size_t(discard_share * double(points.size()));
  std::vector<Vec3d> kept = points;
  const auto end = kept.end() - std::ptrdiff_t(discarded);
  if (discarded > 0)
    std::nth_element(kept.begin(), end, kept.end(), [&](const Vec3d& a, const Vec3d& b) {
      return std::abs(deviation(first, a)) < std::abs(deviation(first, b));
    });
  kept.erase(end, kept.end());
  RELIEVO_TRY_ASSIGN(const Form form, fit(kept));
  FormReading<Form> reading = judge(form, kept);
  reading.discarded = discarded;
  return reading;
}

}  // namespace

Result<Sphere> fit_sphere(const std::vector<Vec3d>& points) {
  if (points.size() < kFewest) return kTooFew;
  const Vec3d middle = middle_of(points);
  RELIEVO_TRY_ASSIGN(Sphere s, guess_sphere(points, middle));
  for (int round = 0; round < 50; ++round) {
    Normal4 system;
    for (const Vec3d& p : points) {
      const Vec3d out = minus(p, s.centre_mm);
      const double r = length(out);
      if (!(r > 0)) continue;
      system.add({out.x / r, out.y / r, out.z / r, 1}, r - s.radius_mm);
    }
    Eigen::Vector4d x;
    if (!system.solve(x)) return kShapeless;
    s.centre_mm = plus(s.centre_mm, {x[0], x[1], x[2]});
    s.radius_mm += x[3];
    if (x.lpNorm<1>() < 1e-10) break;
  }
  if (!std::isfinite(s.radius_mm) || !(s.radius_mm > 0)) return kShapeless;
  return s;
}

Result<Plane> fit_plane(const std::vector<Vec3d>& points) {
  if (points.size() < kFewest) return kTooFew;
  const Vec3d middle = middle_of(points);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3d& point : points) {
    const Vec3d p = minus(point, middle);
    const Eigen::Vector3d d(p.x, p.y, p.z);
    spread += d * d.transpose();
  }
  // Least first. On a line any normal across it would do.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
  if (!(eigen.eigenvalues()[1] > 1e-9 * eigen.eigenvalues()[2])) return kShapeless;
  const Eigen::Vector3d n = eigen.eigenvectors().col(0);
  const Vec3d normal = times(Vec3d{n.x(), n.y(), n.z()}, n.z() > 0 ? -1 : 1);
  return Plane{middle, normal};
}

Result<FormReading<Sphere>> read_sphere(const std::vector<Vec3d>& points, double discard_share) {
  return read_form<Sphere>(points, discard_share, fit_sphere);
}

Result<FormReading<Plane>> read_plane(const std::vector<Vec3d>& points, double discard_share) {
  return read_form<Plane>(points, discard_share, fit_plane);
}

std::optional<RigidTransform> step_onto(const std::vector<Contact>& contacts, const Vec3d& pivot) {
  SquareOf<6> a = SquareOf<6>::Zero();
  ColumnOf<6> b = ColumnOf<6>::Zero();
  for (const Contact& c : contacts) {
    const Vec3d lever = cross(minus(c.point_mm, pivot), c.normal);
    const ColumnOf<6> row{{lever.x, lever.y, lever.z, c.normal.x, c.normal.y, c.normal.z}};
    a += row * row.transpose();
    b += dot(minus(c.surface_mm, c.point_mm), c.normal) * row;
  }
  const ColumnOf<6> x = solved<6>(a, b);
  if (!x.allFinite()) return std::nullopt;
  return small_motion({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, pivot);
}

}  // namespace relievo::pipeline::best_fit
