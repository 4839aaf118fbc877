// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head_completion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/mesh/completion/fitted_head.h"
#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/completion/globe.h"
#include "pipeline/mesh/completion/globe_plate.h"
#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"

namespace relievo::pipeline {
namespace {

constexpr double kFitCellMm = 2;
constexpr int kFiner = 2;        // how often the generic head's globe is quartered
constexpr double kStepMm = 2.1;  // then from node to node, at 105 mm from the centre
constexpr double kFairedMm = 10;
constexpr double kPlaneMm = 320, kPlaneCellMm = 2;

// Seen from the globe's centre, on a plane: a sphere from its pole behind the head (stereographic, so that
// triangles keep their angles), 100 mm large. That pole itself has no place.
Vec2d plane_of(const Vec3d& direction) {
  const double scale = 200 / std::max(1e-9, 1 + direction.z);
  return {direction.x * scale, direction.y * scale};
}

struct Globed {
  Vec2d plane;
  double radius;
};

Globed globed(const Vec3d& in_head) {
  const Vec3d from{in_head.x - kGlobeCentre.x, in_head.y - kGlobeCentre.y, in_head.z - kGlobeCentre.z};
  const double radius = std::hypot(from.x, from.y, from.z);
  return {plane_of({from.x / radius, from.y / radius, from.z / radius}), radius};
}

// The surface as it is, in the plane; the radius is its height.
FaceMesh laid_flat(const FaceMesh& mesh, const RigidTransform& head_from_camera, Arena& scratch) {
  FaceMesh flat(&scratch);
  flat.vertices_mm.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) {
    const Globed g = globed(apply(
        head_from_camera, {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}));
    flat.vertices_mm.push_back(
        {static_cast<float>(g.plane.x), static_cast<float>(g.plane.y), static_cast<float>(g.radius)});
  }
  flat.measured.assign(mesh.vertices_mm.size(), 1);  // gaps that the mesher closed are surface here
  flat.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  return flat;
}

// 1 where a node shows nothing of its own, nor does a neighbour.
std::vector<char> apart(const Globe& globe, std::span<const double> off) {
  std::vector<char> free(off.size());
  for (std::size_t v = 0; v < off.size(); ++v) free[v] = std::isnan(off[v]) ? 1 : 0;
  const std::vector<char> own = free;
  for (const auto& t : globe.triangles)
    if (own[t[0]] == 0 || own[t[1]] == 0 || own[t[2]] == 0)
      for (const std::uint32_t v : t) free[v] = 0;
  return free;
}

}  // namespace

Result<FaceMesh> GenericHeadCompletion::complete(FaceMesh mesh, const Vec3d& across,
                                                 StageContext& context) const {
  const Error stopped{Errc::Cancelled, "completion was stopped"};
  const Result<HeadFrame> frame = find_head_frame(mesh, context, across);
  if (!frame) {
    if (frame.error().code == Errc::PoorGeometry) return mesh;
    return frame.error();
  }
  Arena& scratch = context.scratch;
  const Arena::Mark mark(scratch);
  const UnrolledHead face(mesh, frame->head_from_camera, kFitCellMm, scratch);
  FittedGlobe fitted = fit_generic_globe(face, kFitCellMm, options_.misfit_mm, &scratch);
  if (context.stop()) return stopped;
  Globe globe(kGlobeTimes, &scratch);
  std::array<std::pmr::vector<double>, 2> fields{std::move(fitted.radius_mm), std::move(fitted.sigma_mm)};
  for (int k = 0; k < kFiner; ++k) globe.quarter(fields);
  const auto& [radius, sigma] = fields;

  const FaceMesh flat = laid_flat(mesh, frame->head_from_camera, scratch);
  FaceRelief own({-kPlaneMm, kPlaneMm, -kPlaneMm, kPlaneMm, kPlaneCellMm}, &scratch);
  own.add(flat, {});
  std::pmr::vector<double> off(radius.size(), std::numeric_limits<double>::quiet_NaN(), &scratch);
  for (std::size_t v = 1; v < off.size(); ++v) {  // the first is the pole
    const Vec2d at = plane_of(globe.direction[v]);
    off[v] = own.at(at.x, at.y) - radius[v];
  }
  const std::vector<char> free = apart(globe, off);
  if (free[0] == 0) return mesh;  // surface behind the head: no face
  continue_over_globe(globe, kStepMm, radius, off);
  if (context.stop()) return stopped;

  const RigidTransform camera_from_head = inverse(frame->head_from_camera);
  const auto addition = [&](std::size_t v) {
    const Vec3d& d = globe.direction[v];
    const double r = radius[v] + off[v];
    const Vec3d at = apply(camera_from_head,
                           {kGlobeCentre.x + r * d.x, kGlobeCentre.y + r * d.y, kGlobeCentre.z + r * d.z});
    const Vec2d plane = plane_of(d);
    return Addition{{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)},
                    {static_cast<float>(plane.x), static_cast<float>(plane.y)},
                    static_cast<float>(sigma[v])};
  };
  std::pmr::vector<Addition> added(&scratch);
  for (std::size_t v = 1; v < off.size(); ++v)
    if (free[v] != 0) added.push_back(addition(v));
  std::pmr::vector<Vec2f> plane(&scratch);
  plane.reserve(flat.vertices_mm.size());
  for (const Vec3f& v : flat.vertices_mm) plane.push_back({v.x, v.y});
  return sew(mesh, plane, added, {std::numeric_limits<float>::max(), addition(0), kFairedMm}, context);
}

}  // namespace relievo::pipeline
