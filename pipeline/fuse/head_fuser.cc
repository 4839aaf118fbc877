// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_fuser.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/fuse/fairing.h"
#include "pipeline/fuse/head_zones.h"
#include "pipeline/fuse/pose_blend.h"
#include "pipeline/fuse/rim.h"
#include "pipeline/fuse/skin_bender.h"
#include "pipeline/mesh/mesher.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kDownward = -0.6;        // cosine to upwards
constexpr float kBandVoxels = 2.5F;       // how far from a point the field reaches
constexpr float kCompletedShare = 0.02F;  // of a measured point's weight
constexpr float kEdgeNodes = 16;          // over which a pose's weight fades
constexpr float kSureMm = 0.15F;          // skin; hair that was half seen through is less certain
// Holes are opened before they are closed; of the outline goes what is narrow, then its corners.
constexpr float kHoleOpenedMm = 8;
constexpr std::array<float, 2> kOutlineOpenedMm{11, 16};
constexpr float kEarSureMm = 0.22F;  // an ear is seen at a slant
constexpr int kEarHolds = 40;        // an ear that hangs on by less is a rag between hair
constexpr int kRimRounds = 20;
constexpr float kRimMoveMm = 0.7F;
constexpr std::uint8_t kClosedRings = 3, kUnsureRings = 9, kLastRings = 3, kEyeRimRings = 1;
constexpr float kHoleRimMm = 400, kBayMouthMm = 25, kClosedSigmaMm = 1;  // of holes and bays that are closed
constexpr int kBands = 32;

// By more than pairs of one good calibration do: then steps are left where one pair's surface ends. Where
// they do not, what looks like a step is a fold of skin.
bool disagree(const Registration& registration) {
  constexpr double kMostRmsMm = 0.15;
  return std::any_of(registration.poses.begin(), registration.poses.end(),
                     [](const RegisteredPose& p) { return p.joined && p.rms_mm > kMostRmsMm; });
}

// Hair is half seen through: beside the face, what is that unsure along the line of sight goes.
void drop_hair(std::span<PoseSurface> poses, const Registration& registration, const HeadZones& zones) {
  constexpr float kSkinMm = 0.7F, kHairMm = 1, kLeastCosine = 0.26F;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    PoseSurface& pose = poses[k];
    for (std::size_t i = 0; i < pose.trust.size(); ++i) {
      if (pose.trust[i] <= 0) continue;
      const float cosine = std::abs(dot(pose.normal[i], unit(pose.at_mm[i])));
      const float along_sight_mm = pose.sigma_mm[i] / std::max(cosine, kLeastCosine);
      if (along_sight_mm <= kSkinMm) continue;
      if (zones.is_face(narrow(apply(registration.poses[k].first_from_pose, wide(pose.at_mm[i]))))) continue;
      pose.trust[i] *= std::clamp((kHairMm - along_sight_mm) / (kHairMm - kSkinMm), 0.0F, 1.0F);
    }
  }
}

}  // namespace

Result<FaceMesh> HeadFuser::fuse(std::span<PoseSurface> poses, const Registration& registration,
                                 const FaceMesh& face, const Landmarks& landmarks,
                                 StageContext& context) const {
  const Error stopped{Errc::Cancelled, "stopped while the poses were fused"};
  RELIEVO_TRY(check_options(options_, "averaged"));
  const HeadZones zones(landmarks, poses[0].head_from_camera, options_.neck_mm);
  drop_hair(poses, registration, zones);
  bend_to_master(poses, registration, {options_.most_bend_mm, options_.bend_width_mm, options_.still_mm},
                 context);
  // Wider than for registration, and after hair and what moved too far went: no step where a surface ends.
  for (PoseSurface& pose : poses) fade_to_edges(pose, kEdgeNodes, &context.scratch);
  if (context.stop()) return stopped;
  const PoseBlend blend(poses, registration, zones, context);
  std::pmr::vector<FieldPoint> points = blend.points(float(options_.voxel_mm));
  if (points.empty()) return no_surface();
  // The master's eyes, and what its mesher completed: about nose and mouth for where no pose measured,
  // further out where none shows anything near, for there the sides know better. Of ears
  // and of what lies below a chin it knows nothing.
  std::pmr::vector<std::uint32_t> own(&context.scratch);
  for (std::uint32_t v = 0; v < face.vertices_mm.size(); ++v) {
    const Vec3f& at = face.vertices_mm[v];
    const bool below = apply(poses[0].head_from_camera.rotation, wide(face.normals[v])).y < kDownward;
    const bool beside = !below && !zones.is_ear(at) && !blend.is_seen_near(at);
    const bool completed = face.measured[v] == 0 && (zones.is_middle(at) || beside);
    if (!completed && !zones.is_eye(at)) continue;
    points.push_back({at, face.normals[v], kCompletedShare});
    own.push_back(v);
  }
  if (context.stop()) return stopped;

  std::pmr::vector<Vec3f> places(&context.scratch);
  places.reserve(points.size());
  for (const FieldPoint& s : points) places.push_back(s.at_mm);
  BandVolume volume = volume_around(places, float(options_.voxel_mm), 4, &context.scratch);
  fill_field(points, kBandVoxels * volume.voxel_mm, volume, context);
  if (context.stop()) return stopped;
  Polygonised surface = polygonise(volume, &context.scratch);
  if (context.stop()) return stopped;

  // Vertices on the poses' surfaces; what lies on none is the master's own, or goes.
  OwnFace own_face(volume, &context.scratch);
  std::stable_partition(own.begin(), own.end(), [&](std::uint32_t v) { return face.measured[v] == 0; });
  for (const std::uint32_t v : own)
    own_face.mark(face.vertices_mm[v], face.sigma_mm[v], face.measured[v] != 0);
  struct Vertex {
    float sigma_mm = 0;
    std::uint8_t pose = 0, measured = 0, kept = 0;
    std::uint8_t poses = 0;  // that say where it lies, a bit each
  };
  std::pmr::vector<Vertex> vertices(surface.vertices_mm.size(), Vertex{}, &context.scratch);
  const auto settle = [&](std::size_t v, const Vec3f& normal) {
    Vec3f& at = surface.vertices_mm[v];
    if (const auto placed = blend.settle(at, normal)) {
      at = placed->at_mm;
      const bool sure = placed->sigma_mm <= float(kMeasuredSigmaMm);
      vertices[v] = {placed->sigma_mm, placed->pose, sure ? std::uint8_t{1} : std::uint8_t{0}, 1,
                     placed->poses};
    } else if (const auto said = own_face.at(at)) {
      vertices[v] = {said->sigma_mm, 0, said->measured ? std::uint8_t{1} : std::uint8_t{0}, 1};
    }
  };
  std::pmr::vector<Vec3f> started(surface.vertices_mm, &context.scratch);
  std::pmr::vector<Vec3f> normals = area_normals(surface.vertices_mm, surface.triangles, &context.scratch);
  context.pool.for_each_band(int(vertices.size()), kBands, [&](int begin, int end, int) {
    for (int v = begin; v < end; ++v) settle(std::size_t(v), unit(normals[std::size_t(v)]));
  });
  std::erase_if(surface.triangles, [&](const Triangle& t) {
    return vertices[t[0]].kept == 0 || vertices[t[1]].kept == 0 || vertices[t[2]].kept == 0;
  });
  std::pmr::vector<std::uint8_t> sure(&context.scratch);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const float most_mm = zones.is_ear(surface.vertices_mm[v]) ? kEarSureMm : kSureMm;
    sure.push_back(vertices[v].measured != 0 && vertices[v].sigma_mm <= most_mm ? 1 : 0);
  }
  const std::size_t settled = vertices.size();
  // What closes a hole was not measured.
  const auto close = [&](std::span<const BorderEdge> border, float mouth_mm) {
    for (const std::uint32_t v :
         close_holes(surface.vertices_mm, normals, border, {kHoleRimMm, mouth_mm}, surface.triangles)) {
      normals.push_back(normals[v]);
      vertices.push_back({kClosedSigmaMm, vertices[v].pose, 0, 1});
      started.push_back(surface.vertices_mm[started.size()]);
      sure.push_back(0);
    }
  };
  const auto trim = [&](float radius_mm, int holds) {
    const Arena::Mark mark(context.scratch);
    open_rims(surface.vertices_mm, sure, surface.triangles, radius_mm, holds, &context.scratch);
    keep_one_surface(surface.vertices_mm, surface.triangles, {}, &context.scratch);
  };
  trim(kHoleOpenedMm, 0);
  close(border_edges(surface.triangles, &context.scratch), 0);
  // Once only the outline is left: tufts of hair, however sure, but no ears.
  for (std::size_t v = 0; v < sure.size(); ++v) sure[v] = sure[v] && zones.is_ear(surface.vertices_mm[v]);
  for (const float radius_mm : kOutlineOpenedMm) {
    trim(radius_mm, kEarHolds);
    if (surface.triangles.empty()) return no_surface();
    const auto border = border_edges(surface.triangles, &context.scratch);
    smooth_rims(surface.vertices_mm, border, kRimRounds, kRimMoveMm, &context.scratch);
    for (const BorderEdge& e : border)
      if (e[0] < settled) settle(e[0], unit(normals[e[0]]));
    part_equals(surface.vertices_mm, started, &context.scratch);
    close(border, kBayMouthMm);
  }

  // Laid anew: what closes a hole, with the last of what was measured beside it; steps, but for those that
  // eyes and ears have; then what was completed or is unsure, where other poses begin to count.
  std::pmr::vector<std::uint8_t> part(vertices.size(), 0, &context.scratch);
  std::pmr::vector<std::uint8_t> stays(part, &context.scratch), label(part, &context.scratch);
  std::fill(part.begin() + std::ptrdiff_t(settled), part.end(), kClosedRings);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    label[v] = v < settled ? vertices[v].poses : kBetweenNothing;
    const Vec3f& at = surface.vertices_mm[v];
    stays[v] = v < settled && !zones.is_eye_rim(at) && (zones.is_eye(at) || zones.is_ear(at));
    if (zones.is_eye_rim(at)) part[v] = std::max(part[v], kEyeRimRings);
  }
  for (const BorderEdge& e : border_edges(surface.triangles, &context.scratch)) stays[e[0]] = 1;
  std::pmr::vector<std::uint8_t> unsure(&context.scratch);
  for (const Vertex& v : vertices) unsure.push_back(v.measured == 0 || v.sigma_mm > kSureMm ? 1 : 0);
  if (disagree(registration))
    add_steps(surface.vertices_mm, surface.triangles, label, part, &context.scratch);
  add_folds(surface.vertices_mm, surface.triangles, unsure, part, &context.scratch);
  const auto lay_anew = [&] {
    const auto moved = fair_part(surface.vertices_mm, surface.triangles, part, stays, &context.scratch);
    for (std::size_t v = 0; v < moved.size(); ++v)
      vertices[v].sigma_mm = std::hypot(vertices[v].sigma_mm, moved[v]);
  };
  lay_anew();
  std::fill(part.begin(), part.end(), std::uint8_t{0});
  for (const Triangle& t : surface.triangles) {
    const bool guessed =
        std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return vertices[v].measured == 0; });
    if (guessed && (label[t[0]] != label[t[1]] || label[t[0]] != label[t[2]]))
      for (const std::uint32_t v : t) part[v] = kUnsureRings;
  }
  // What was measured stays, but for the last of it.
  std::pmr::vector<std::uint8_t> last(vertices.size(), 0, &context.scratch);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (v >= settled || vertices[v].poses == 0 || vertices[v].measured == 0) last[v] = kLastRings + 1;
  spread_rings(surface.triangles, last);
  for (std::size_t v = 0; v < settled; ++v)
    if (last[v] == 0) stays[v] = 1;
  lay_anew();

  std::pmr::vector<std::uint8_t> pose(&context.output);
  pose.reserve(vertices.size());
  FaceMesh mesh = pack_mesh(vertices.size(), surface.triangles, context, [&](std::size_t v) {
    pose.push_back(vertices[v].pose);
    return PackedVertex{surface.vertices_mm[v], vertices[v].sigma_mm, vertices[v].measured};
  });
  mesh.pose = std::move(pose);
  compute_normals(mesh, 1, &context.scratch);
  return mesh;
}

}  // namespace relievo::pipeline
