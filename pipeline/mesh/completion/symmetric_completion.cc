// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/symmetric_completion.h"

#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"

namespace relievo::pipeline {
namespace {

// Not where the border's own triangles still lie.
std::pmr::vector<Addition> additions(const UnrolledHead& head, const RigidTransform& camera_from_head,
                                     const SymmetricCompletion& options, Arena& scratch) {
  std::pmr::vector<Addition> all(&scratch);
  for (int r = 0; r < head.own.rows(); ++r)
    for (int c = 0; c < head.own.columns(); ++c) {
      const float radius = head.added.z(c, r);
      const float away = head.distance_mm[head.index(c, r)];
      if (std::isnan(radius) || away < 1.5F * float(options.cell_mm)) continue;
      const double arc = head.own.x_mm(c), y = head.own.y_mm(r);
      const Vec3d at = apply(camera_from_head, rolled(arc, y, double(radius)));
      const double sigma = options.sigma_mm + options.sigma_per_mm * double(away);
      all.push_back({{float(at.x), float(at.y), float(at.z)}, {float(arc), float(y)}, float(sigma)});
    }
  return all;
}

}  // namespace

Result<void> SymmetricCompletion::check() const {
  if (longest_edge_mm < 2 * cell_mm)
    return Error{Errc::InvalidInput, "longest_edge_mm must be at least two cells"}.at("symmetric");
  return {};
}

Result<FaceMesh> SymmetricCompletion::complete(FaceMesh mesh, const Vec3d& across,
                                               StageContext& context) const {
  const Error stopped{Errc::Cancelled, "completion was stopped"};
  const Result<HeadFrame> frame = find_head_frame(mesh, context, across);
  if (!frame) {
    if (frame.error().code == Errc::PoorGeometry) return mesh;
    return frame.error();
  }
  const Arena::Mark mark(context.scratch);
  UnrolledHead head(mesh, frame->head_from_camera, cell_mm, context.scratch);
  if (context.stop()) return stopped;
  head.add([&head](int c, int r) { return head.own.z(head.own.columns() - 1 - c, r); }, cell_mm,
           context.scratch);
  if (context.stop()) return stopped;
  const auto added = additions(head, inverse(frame->head_from_camera), *this, context.scratch);
  if (added.empty()) return mesh;
  std::pmr::vector<Vec2f> plane(&context.scratch);
  plane.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : head.flat.vertices_mm) plane.push_back({v.x, v.y});
  return sew(mesh, plane, added, {longest_edge_mm}, context);
}

}  // namespace relievo::pipeline
