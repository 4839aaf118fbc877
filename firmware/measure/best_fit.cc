// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/best_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::firmware::measure {
namespace {

constexpr std::size_t kFewest = 20;

const Error kTooFew{Errc::PoorGeometry, "too few points for a best fit: the target was hardly seen"};
const Error kShapeless{Errc::PoorGeometry,
                       "these points determine no sphere or plane: they do not lie on one surface"};

using Row4 = std::array<double, 4>;

// Normal equations of four unknowns; Cholesky. False where the points leave one of them open.
class Normal4 {
 public:
  void add(const Row4& row, double value) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j <= i; ++j) a_[i][j] += row[i] * row[j];
      b_[i] += row[i] * value;
    }
  }
  bool solve(Row4& x) {
    const double scale = std::max({a_[0][0], a_[1][1], a_[2][2], a_[3][3]});
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double s = a_[i][j];
        for (std::size_t k = 0; k < j; ++k) s -= a_[i][k] * a_[j][k];
        if (i == j && !(s > 1e-12 * scale)) return false;
        a_[i][j] = i == j ? std::sqrt(s) : s / a_[j][j];
      }
    for (std::size_t i = 0; i < 4; ++i) {
      x[i] = b_[i];
      for (std::size_t k = 0; k < i; ++k) x[i] -= a_[i][k] * x[k];
      x[i] /= a_[i][i];
    }
    for (std::size_t i = 4; i-- > 0;) {
      for (std::size_t k = i + 1; k < 4; ++k) x[i] -= a_[k][i] * x[k];
      x[i] /= a_[i][i];
    }
    return true;
  }

 private:
  std::array<Row4, 4> a_{};
  Row4 b_{};
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
  Row4 x{};
  if (!system.solve(x)) return kShapeless;
  const Vec3d centre{x[0] / 2, x[1] / 2, x[2] / 2};
  return Sphere{plus(middle, times(centre, size)),
                size * std::sqrt(std::max(0.0, x[3] + dot(centre, centre)))};
}

// The direction in which the points spread least: inverse iteration on their covariance.
struct Spread {
  std::array<std::array<double, 3>, 3> c{};
  Vec3d times(const Vec3d& v) const {
    return {c[0][0] * v.x + c[0][1] * v.y + c[0][2] * v.z, c[1][0] * v.x + c[1][1] * v.y + c[1][2] * v.z,
            c[2][0] * v.x + c[2][1] * v.y + c[2][2] * v.z};
  }
  // The adjugate's columns point where the inverse's do.
  Spread adjugate() const {
    const Vec3d x{c[0][0], c[1][0], c[2][0]}, y{c[0][1], c[1][1], c[2][1]}, z{c[0][2], c[1][2], c[2][2]};
    const Vec3d a = cross(y, z), b = cross(z, x), d = cross(x, y);
    return {{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {d.x, d.y, d.z}}}};
  }
};

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
    Row4 x{};
    if (!system.solve(x)) return kShapeless;
    s.centre_mm = plus(s.centre_mm, {x[0], x[1], x[2]});
    s.radius_mm += x[3];
    if (std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]) + std::abs(x[3]) < 1e-10) break;
  }
  if (!std::isfinite(s.radius_mm) || !(s.radius_mm > 0)) return kShapeless;
  return s;
}

Result<Plane> fit_plane(const std::vector<Vec3d>& points) {
  if (points.size() < kFewest) return kTooFew;
  const Vec3d middle = middle_of(points);
  Spread spread;
  for (const Vec3d& point : points) {
    const Vec3d d = minus(point, middle);
    const std::array<double, 3> p{d.x, d.y, d.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) spread.c[i][j] += p[i] * p[j];
  }
  // A whisker on the diagonal keeps an exact plane from dividing by nothing.
  const double size = spread.c[0][0] + spread.c[1][1] + spread.c[2][2];
  if (!(size > 0)) return kShapeless;
  for (std::size_t i = 0; i < 3; ++i) spread.c[i][i] += 1e-12 * size;
  const Spread inverse = spread.adjugate();
  Vec3d normal{0.3, 0.5, -0.8};
  for (int round = 0; round < 200; ++round) {
    const Vec3d next = inverse.times(normal);
    const double l = length(next);
    if (!(l > 0)) return kShapeless;
    const Vec3d unit = times(next, 1 / l);
    const double turned = length(cross(unit, normal));
    normal = unit;
    if (turned < 1e-14) break;
  }
  if (normal.z > 0) normal = times(normal, -1);
  // On a line any normal across it would do.
  const Vec3d along = spread.times(cross(normal, {1, 0, 0})), across = spread.times(cross(normal, {0, 1, 0}));
  if (length(cross(along, across)) < 1e-9 * size * size) return kShapeless;
  return Plane{middle, normal};
}

Result<FormReading<Sphere>> read_sphere(const std::vector<Vec3d>& points, double discard_share) {
  return read_form<Sphere>(points, discard_share, fit_sphere);
}

Result<FormReading<Plane>> read_plane(const std::vector<Vec3d>& points, double discard_share) {
  return read_form<Plane>(points, discard_share, fit_plane);
}

}  // namespace relievo::firmware::measure
