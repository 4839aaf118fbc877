// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/measurement.h"

#include <algorithm>

#include "hal/base/statistics.h"
#include "pipeline/reconstruct/best_fit.h"

namespace relievo::firmware::measure {
namespace {

constexpr double kTruthReachMm = 20;
constexpr double kModelReachMm = 10;
constexpr std::size_t kSamples = 100'000;

double share_within(const std::vector<double>& values, double limit) {
  const auto n = std::ranges::count_if(values, [&](double v) { return v <= limit; });
  return values.empty() ? 0 : double(n) / double(values.size());
}

Surface measured_part(const pipeline::FaceMesh& mesh) {
  Surface surface;
  surface.vertices_mm.assign(mesh.vertices_mm.begin(), mesh.vertices_mm.end());
  const auto seen = [&](std::uint32_t v) { return mesh.measured.empty() || mesh.measured[v] != 0; };
  for (const auto& t : mesh.triangles) {
    if (seen(t[0]) && seen(t[1]) && seen(t[2])) surface.triangles.push_back(t);
  }
  return surface;
}

// Points spread evenly, the same every time: a new one after every `step` of area.
std::vector<Vec3d> spread(const Surface& surface, std::size_t count) {
  const auto corner = [&](const auto& t, std::size_t k) { return wide(surface.vertices_mm[t[k]]); };
  const auto area = [&](const auto& t) {
    return 0.5 * length(cross(minus(corner(t, 1), corner(t, 0)), minus(corner(t, 2), corner(t, 0))));
  };
  double total = 0;
  for (const auto& t : surface.triangles) total += area(t);
  std::vector<Vec3d> points;
  if (!(total > 0)) return points;
  const double step = total / double(count);
  double due = step / 2;
  double a = 0.5;
  double b = 0.5;
  for (const auto& t : surface.triangles) {
    due += area(t);
    while (due >= step) {
      due -= step;
      a += 0.7548776662466927;  // Roberts' low-discrepancy pair
      b += 0.5698402909980532;
      a -= std::floor(a);
      b -= std::floor(b);
      const bool fold = a + b > 1;
      const double u = fold ? 1 - a : a;
      const double v = fold ? 1 - b : b;
      points.push_back(
          plus(times(corner(t, 0), 1 - u - v), plus(times(corner(t, 1), u), times(corner(t, 2), v))));
    }
  }
  return points;
}

void measure_surface(const Surface& model, const TruthView& truth, const TriangleGrid& true_surface,
                     Measurement& m) {
  std::vector<double> accuracy;
  std::vector<double> interior;
  std::size_t far = 0;
  const std::vector<Vec3d> samples = spread(model, kSamples);
  for (const Vec3d& p : samples) {
    const auto near = true_surface.nearest(p, kTruthReachMm);
    const double d = near ? near->distance_mm : kTruthReachMm;
    const std::uint8_t flags = truth.flags_at(p);
    if ((flags & TruthView::kJudged) == TruthView::kJudged) {
      accuracy.push_back(d);
      if ((flags & TruthView::kInterior) != 0) interior.push_back(d);
    }
    if (d > 3) ++far;
  }
  m.accuracy_median_mm = median(accuracy);
  m.accuracy_p95_mm = percentile(accuracy, 0.95);
  m.interior_median_mm = median(interior);
  m.interior_p95_mm = percentile(interior, 0.95);
  m.outliers_3mm = samples.empty() ? 0 : double(far) / double(samples.size());
}

void measure_sigma(const pipeline::FaceMesh& mesh, const Surface& moved, const TruthView& truth,
                   const TriangleGrid& true_surface, Measurement& m) {
  std::size_t asked = 0;
  std::size_t one = 0;
  std::size_t two = 0;
  for (std::size_t i = 0; i < moved.vertices_mm.size(); ++i) {
    if (!mesh.measured.empty() && mesh.measured[i] == 0) continue;
    const Vec3d p = wide(moved.vertices_mm[i]);
    const std::uint8_t flags = truth.flags_at(p);
    if ((flags & TruthView::kJudged) != TruthView::kJudged) continue;
    ++m.measured_vertices;
    if (mesh.sigma_mm.empty() || (flags & TruthView::kInterior) == 0 || i % 5 != 0) continue;
    const auto near = true_surface.nearest(p, kTruthReachMm);
    if (!near) continue;
    ++asked;
    one += near->distance_mm <= double(mesh.sigma_mm[i]) ? 1U : 0U;
    two += near->distance_mm <= 1.96 * double(mesh.sigma_mm[i]) ? 1U : 0U;
  }
  if (asked == 0) return;
  m.within_sigma = double(one) / double(asked);
  m.within_196_sigma = double(two) / double(asked);
}

}  // namespace

RigidFit fit_rigidly(const std::vector<Vec3d>& points, const TriangleGrid& surface) {
  RigidFit fit;
  if (points.empty()) return fit;
  pipeline::RigidTransform& t = fit.surface_from_points;
  // About the middle of the points: turning and moving are then nearly independent.
  const Vec3d middle = points[points.size() / 2];
  for (int round = 0; round < 25; ++round) {
    const double reach_mm = round < 6 ? 12 : round < 12 ? 4 : 1.5;
    std::vector<pipeline::best_fit::Contact> contacts;
    for (const Vec3d& point : points) {
      const Vec3d p = apply(t, point);
      if (const auto near = surface.nearest(p, reach_mm)) contacts.push_back({p, near->at_mm, near->normal});
    }
    if (contacts.size() < 100) break;
    const auto step = pipeline::best_fit::step_onto(contacts, middle);
    if (!step) break;
    t = product(*step, t);
    if (distance(apply(*step, middle), middle) + pipeline::turned_deg(step->rotation) < 5e-6) break;
  }
  fit.moved_mm = distance(apply(t, middle), middle);
  fit.turned_deg = pipeline::turned_deg(t.rotation);
  return fit;
}

Measurement measure(const pipeline::FaceMesh& mesh, const TruthView& truth, const Surface& true_head) {
  Measurement m;
  Surface model = measured_part(mesh);
  const std::vector<Vec3d> asked = truth.judged_points(50'000);
  {
    // The truth's points onto the model, as the surface asked about is the smaller one; then the model back.
    const TriangleGrid grid(model);
    std::vector<Vec3d> some;
    for (std::size_t i = 0; i < asked.size(); i += 4) some.push_back(asked[i]);
    const RigidFit fit = fit_rigidly(some, grid);
    const pipeline::RigidTransform back = inverse(fit.surface_from_points);
    for (Vec3f& v : model.vertices_mm) v = narrow(apply(back, wide(v)));
    m.moved_mm = fit.moved_mm;
    m.turned_deg = fit.turned_deg;
  }
  const TriangleGrid true_surface(true_head);
  measure_surface(model, truth, true_surface, m);
  measure_sigma(mesh, model, truth, true_surface, m);
  const TriangleGrid model_surface(model);
  std::vector<double> gaps;
  for (const Vec3d& p : asked) {
    const auto near = model_surface.nearest(p, kModelReachMm);
    gaps.push_back(near ? near->distance_mm : kModelReachMm);
  }
  m.complete_quarter_mm = share_within(gaps, 0.25);
  m.complete_half_mm = share_within(gaps, 0.5);
  m.complete_1mm = share_within(gaps, 1);
  return m;
}

}  // namespace relievo::firmware::measure
