// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/symmetric_completion.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/completion/gap_triangulation.h"
#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr double kAxisBehind = 90;      // mm behind the tip: the head's upright axis
constexpr double kArcRadius = 80;       // mm: turns angles about it into lengths
constexpr double kHalfArc = 125;        // to the ears
constexpr double kBelow = 95, kAbove = 95;
constexpr int kRelaxRounds = 150;

Vec3d wide(const Vec3f& v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }
Vec3f narrow(const Vec3d& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

// Arc, height and radius about the head's axis.
Vec3f unrolled(const Vec3d& in_head) {
  const double z = in_head.z + kAxisBehind;
  return {static_cast<float>(kArcRadius * std::atan2(in_head.x, z)), static_cast<float>(in_head.y), static_cast<float>(std::hypot(in_head.x, z))};
}
Vec3d rolled(double arc, double y, double radius) {
  const double angle = arc / kArcRadius;
  return {radius * std::sin(angle), y, radius * std::cos(angle) - kAxisBehind};
}

using Edge = std::array<std::uint32_t, 2>;

// Directed edges that one triangle alone has.
std::pmr::vector<Edge> border_of(const FaceMesh& mesh, Arena& scratch) {
  struct Half { Edge key; Edge as_run; };
  std::pmr::vector<Half> all(&scratch);
  all.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e{t[k], t[(k + 1) % 3]};
      all.push_back({{std::min(e[0], e[1]), std::max(e[0], e[1])}, e});
    }
  std::sort(all.begin(), all.end(), [](const Half& l, const Half& r) { return l.key < r.key; });
  std::pmr::vector<Edge> border(&scratch);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i + 1;
    while (j < all.size() && all[j].key == all[i].key) ++j;
    if (j - i == 1) border.push_back(all[i].as_run);
    i = j;
  }
  return border;
}

// The measured surface unrolled, and what the mirrored one adds to it.
class Unrolled {
 public:
  Unrolled(const FaceMesh& mesh, const RigidTransform& head_from_camera, double cell_mm, Arena& scratch)
      : flat(&scratch), own({-kHalfArc, kHalfArc, -kBelow, kAbove, cell_mm}, &scratch), added({-kHalfArc, kHalfArc, -kBelow, kAbove, cell_mm}, &scratch),
        distance_mm(&scratch) {
    flat.vertices_mm.reserve(mesh.vertices_mm.size());
    for (const Vec3f& v : mesh.vertices_mm) flat.vertices_mm.push_back(unrolled(apply(head_from_camera, wide(v))));
    flat.measured.assign(mesh.vertices_mm.size(), 1);  // gaps that the mesher closed are surface here
    flat.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    own.add(flat, {});
    mirror(cell_mm, scratch);
  }

  FaceMesh flat;
  FaceRelief own, added;
  std::pmr::vector<float> distance_mm;  // of an added cell from the measured ones

 private:
  bool has_own(int c, int r) const { return own.inside(c, r) && !std::isnan(own.z(c, r)); }
  std::size_t index(int c, int r) const { return static_cast<std::size_t>(r * own.columns() + c); }

  void mirror(double cell_mm, Arena& scratch) {
    const int columns = own.columns(), rows = own.rows();
    std::pmr::vector<float> shift(static_cast<std::size_t>(columns * rows), 0.0F, &scratch);
    std::pmr::vector<std::uint8_t> fixed(shift.size(), 0, &scratch);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const float other = own.z(columns - 1 - c, r);
        if (std::isnan(other)) continue;
        if (has_own(c, r)) shift[index(c, r)] = std::clamp(own.z(c, r) - other, -4.0F, 4.0F), fixed[index(c, r)] = 1;
        else added.z(c, r) = other;
      }
    relax(shift, fixed);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) added.z(c, r) += shift[index(c, r)];
    measure_distance(static_cast<float>(cell_mm));
  }

  // The difference of both sides along their seam, carried into the added part.
  void relax(std::pmr::vector<float>& shift, const std::pmr::vector<std::uint8_t>& fixed) {
    for (int round = 0; round < kRelaxRounds; ++round)
      for (int r = 0; r < own.rows(); ++r)
        for (int c = 0; c < own.columns(); ++c) {
          if (fixed[index(c, r)] != 0 || std::isnan(added.z(c, r))) continue;
          float sum = 0;
          int count = 0;
          for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            if (!own.inside(c + dc, r + dr)) continue;
            if (fixed[index(c + dc, r + dr)] == 0 && std::isnan(added.z(c + dc, r + dr))) continue;
            sum += shift[index(c + dc, r + dr)];
            ++count;
          }
          if (count > 0) shift[index(c, r)] = sum / static_cast<float>(count);
        }
  }

  // City blocks, two sweeps.
  void measure_distance(float cell_mm) {
    const int columns = own.columns(), rows = own.rows();
    distance_mm.assign(static_cast<std::size_t>(columns * rows), 1e6F);
    const auto step = [&](int c, int r, int dc, int dr) {
      if (has_own(c, r)) distance_mm[index(c, r)] = 0;
      else if (own.inside(c + dc, r + dr)) distance_mm[index(c, r)] = std::min(distance_mm[index(c, r)], distance_mm[index(c + dc, r + dr)] + cell_mm);
    };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) step(c, r, -1, 0), step(c, r, 0, -1);
    for (int r = rows; r-- > 0;)
      for (int c = columns; c-- > 0;) step(c, r, 1, 0), step(c, r, 0, 1);
  }
};

struct Addition {
  Vec3f at_mm;    // the camera's frame
  Vec2f plane;
  float sigma_mm;
};

std::pmr::vector<Addition> additions(const Unrolled& surface, const RigidTransform& camera_from_head, const SymmetricCompletionOptions& o, Arena& scratch) {
  std::pmr::vector<Addition> all(&scratch);
  for (int r = 0; r < surface.own.rows(); ++r)
    for (int c = 0; c < surface.own.columns(); ++c) {
      const float radius = surface.added.z(c, r);
      const float away = surface.distance_mm[static_cast<std::size_t>(r * surface.own.columns() + c)];
      // Not where the border's own triangles still lie.
      if (std::isnan(radius) || away < 1.5F * static_cast<float>(o.cell_mm)) continue;
      const double arc = surface.own.x_mm(c), y = surface.own.y_mm(r);
      all.push_back({narrow(apply(camera_from_head, rolled(arc, y, static_cast<double>(radius)))),
                     {static_cast<float>(arc), static_cast<float>(y)},
                     static_cast<float>(o.sigma_mm + o.sigma_per_mm * static_cast<double>(away))});
    }
  return all;
}

// What the gap's triangles may be: short edges, seen from outside, and no edge that the surface has already.
bool fits(const FaceMesh& mesh, const Triangle& t, float longest_mm) {
  for (std::size_t k = 0; k < 3; ++k)
    if (mesh::squared_distance(mesh.vertices_mm[t[k]], mesh.vertices_mm[t[(k + 1) % 3]]) > longest_mm * longest_mm) return false;
  return true;
}

// Vertices that no triangle uses go; the order of the rest stays.
FaceMesh compacted(const FaceMesh& mesh, Arena& output, Arena& scratch) {
  std::pmr::vector<std::uint32_t> place(mesh.vertices_mm.size(), 0, &scratch);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) place[v] = 1;
  std::uint32_t count = 0;
  for (std::uint32_t& p : place) p = p != 0 ? ++count : 0;
  FaceMesh out(&output);
  out.vertices_mm.reserve(count), out.normals.reserve(count), out.sigma_mm.reserve(count), out.measured.reserve(count);
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0) continue;
    out.vertices_mm.push_back(mesh.vertices_mm[v]);
    out.normals.push_back(mesh.normals[v]);
    out.sigma_mm.push_back(mesh.sigma_mm[v]);
    out.measured.push_back(mesh.measured[v]);
  }
  out.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) out.triangles.push_back({place[t[0]] - 1, place[t[1]] - 1, place[t[2]] - 1});
  return out;
}

FaceMesh joined(const FaceMesh& mesh, Unrolled& surface, std::span<const Addition> added, const SymmetricCompletionOptions& o, StageContext& context) {
  FaceMesh whole(&context.scratch);
  whole.vertices_mm.assign(mesh.vertices_mm.begin(), mesh.vertices_mm.end());
  whole.sigma_mm.assign(mesh.sigma_mm.begin(), mesh.sigma_mm.end());
  whole.measured.assign(mesh.measured.begin(), mesh.measured.end());
  whole.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  std::pmr::vector<Vec2f> plane(&context.scratch);
  plane.reserve(mesh.vertices_mm.size() + added.size());
  for (const Vec3f& v : surface.flat.vertices_mm) plane.push_back({v.x, v.y});
  std::pmr::vector<std::uint32_t> fresh(&context.scratch);
  for (const Addition& a : added) {
    fresh.push_back(static_cast<std::uint32_t>(whole.vertices_mm.size()));
    whole.vertices_mm.push_back(a.at_mm);
    whole.sigma_mm.push_back(a.sigma_mm);
    whole.measured.push_back(0);
    plane.push_back(a.plane);
  }
  const auto border = border_of(mesh, context.scratch);
  const auto gap = triangulate_gap(plane, border, fresh, &context.scratch);
  for (const Triangle& t : gap)
    if (fits(whole, t, static_cast<float>(o.longest_edge_mm))) whole.triangles.push_back(t);
  keep_one_surface(whole.vertices_mm, whole.triangles, {0}, &context.scratch);
  compute_normals(whole, 1, &context.scratch);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    if (mesh.measured[v] != 0) whole.normals[v] = mesh.normals[v];
  return compacted(whole, context.output, context.scratch);
}

}  // namespace

Result<void> SymmetricCompletionOptions::check() const {
  if (!(cell_mm >= 0.5 && cell_mm <= 10)) return Error{Errc::InvalidInput, "cell_mm must lie in 0.5 .. 10"}.at("symmetric");
  if (!(longest_edge_mm >= 2 * cell_mm && longest_edge_mm <= 50))
    return Error{Errc::InvalidInput, "longest_edge_mm must lie between two cells and 50"}.at("symmetric");
  if (!(sigma_mm >= 0 && sigma_mm <= 20 && sigma_per_mm >= 0 && sigma_per_mm <= 1))
    return Error{Errc::InvalidInput, "sigma_mm must lie in 0 .. 20, sigma_per_mm in 0 .. 1"}.at("symmetric");
  return {};
}

Result<FaceMesh> SymmetricCompletion::complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const {
  const Result<HeadFrame> frame = find_head_frame(mesh, {}, context, across);
  if (!frame) {
    if (frame.error().code == Errc::PoorGeometry) return mesh;
    return frame.error();
  }
  const Arena::Mark mark(context.scratch);
  Unrolled surface(mesh, frame->head_from_camera, options_.cell_mm, context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "completion was stopped"};
  const auto added = additions(surface, inverse(frame->head_from_camera), options_, context.scratch);
  if (added.empty()) return mesh;
  return joined(mesh, surface, added, options_, context);
}

}  // namespace relievo::pipeline
