// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_fuser.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/kinds.h"
#include "pipeline/fuse/head_zones.h"
#include "pipeline/fuse/pose_blend.h"
#include "pipeline/fuse/rim.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kDownward = -0.6, kUpward = 0.5;  // cosine to upwards
constexpr float kAwayFromCamera = 0.3F;            // cosine to the line of sight
constexpr float kBandVoxels = 2.5F;                // how far from a point the field reaches
constexpr float kCompletedShare = 0.02F;           // of a measured point's weight
constexpr float kEdgeNodes = 16;                   // over which a pose's weight fades
constexpr float kSureMm = 0.15F;                   // skin; hair that was half seen through is less certain
// Holes are opened before they are closed; of the outline goes what is narrow, then its corners.
constexpr float kHoleOpenedMm = 8;
constexpr std::array<float, 2> kOutlineOpenedMm{11, 16};
constexpr float kEarSureMm = 0.22F;  // an ear is seen at a slant
constexpr int kEarHolds = 40;        // an ear that hangs on by less is a rag between hair
constexpr int kRimRounds = 20;
constexpr float kRimMoveMm = 0.7F;
constexpr std::uint8_t kClosedRings = 3, kUnsureRings = 9, kLastRings = 3, kEyeRimRings = 1;
constexpr float kHoleRimMm = 400, kBayMouthMm = 25, kThroatMouthMm = 45,
                kClosedSigmaMm = 1;  // of holes and bays that are closed
constexpr int kBands = 32;

// By more than pairs of one good calibration do: then steps are left where one pair's surface ends. Where
// they do not, what looks like a step is a fold of skin.
bool disagree(const Registration& registration) {
  constexpr double kMostRmsMm = 0.15;
  return std::any_of(registration.poses.begin(), registration.poses.end(),
                     [](const RegisteredPose& p) { return p.joined && p.rms_mm > kMostRmsMm; });
}

// Hair is half seen through: beside the face, what is that unsure along the line of sight goes.
void drop_hair(std::span<HeadPose> poses, const Registration& registration, const HeadZones& zones) {
  constexpr float kSkinMm = 0.7F, kHairMm = 1, kLeastCosine = 0.26F;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    HeadPose& pose = poses[k];
    for (std::size_t i = 0; i < pose.nodes.size(); ++i) {
      if (pose.nodes[i].trust <= 0) continue;
      const float cosine = std::abs(dot(pose.nodes[i].normal, unit(pose.nodes[i].at_mm)));
      const float along_sight_mm = pose.nodes[i].sigma_mm / std::max(cosine, kLeastCosine);
      if (along_sight_mm <= kSkinMm) continue;
      if (zones.is_face(narrow(apply(registration.poses[k].first_from_pose, wide(pose.nodes[i].at_mm)))))
        continue;
      pose.nodes[i].trust *= std::clamp((kHairMm - along_sight_mm) / (kHairMm - kSkinMm), 0.0F, 1.0F);
    }
  }
}

// The master's eyes, and what its mesher completed: about nose and mouth for where no pose measured, further
// out where none shows anything near, for there the sides know better. Of ears and of what lies below a chin
// it knows nothing; of a completed crown or back, loose plates would be left. Adds them to the points;
// returns the vertices, what was completed first.
std::pmr::vector<std::uint32_t> add_own(const FaceMesh& face, const RigidTransform& head_from_camera,
                                        const HeadZones& zones, const PoseBlend& blend,
                                        std::pmr::vector<FieldPoint>& points) {
  std::pmr::vector<std::uint32_t> own(points.get_allocator());
  for (std::uint32_t v = 0; v < face.vertices_mm.size(); ++v) {
    const Vec3f& at = face.vertices_mm[v];
    const double upwards = apply(head_from_camera.rotation, wide(face.normals[v])).y;
    const float away = dot(face.normals[v], unit(at));
    const bool behind = away > kAwayFromCamera || (away > 0 && upwards > kUpward);
    const bool beside = !behind && upwards >= kDownward && !zones.is_ear(at) && !blend.is_seen_near(at);
    const bool completed = face.measured[v] == 0 && (zones.is_middle(at) || beside);
    if (!completed && !zones.is_eye(at)) continue;
    points.push_back({at, face.normals[v], kCompletedShare});
    own.push_back(v);
  }
  std::stable_partition(own.begin(), own.end(), [&](std::uint32_t v) { return face.measured[v] == 0; });
  return own;
}

// The surface while it is made, in this order: vertices are placed on what the poses show, rims trimmed and
// holes closed, and what lies in steps or was guessed is laid anew.
class Surface {
 public:
  Surface(Polygonised&& polygonised, const PoseBlend& blend, const HeadZones& zones, StageContext& context)
      : vertices_mm_(std::move(polygonised.vertices_mm)),
        triangles_(std::move(polygonised.triangles)),
        blend_(blend),
        zones_(zones),
        context_(context) {
    // What closes holes comes to them: vectors that grow in an arena leave all they were before behind.
    const std::size_t most = vertices_mm_.size() + vertices_mm_.size() / 8;
    vertices_mm_.reserve(most);
    triangles_.reserve(2 * most);
    vertices_.reserve(most);
    started_.reserve(most);
    normals_.reserve(most);
    sure_.reserve(most);
    vertices_.resize(vertices_mm_.size());
    started_ = vertices_mm_;
    const Arena::Mark mark(context.scratch);
    const auto normals = area_normals(vertices_mm_, triangles_, scratch_);
    normals_.assign(normals.begin(), normals.end());
  }

  // What lies on no pose's surface is the master's own, or goes.
  void place(const OwnFace& own) {
    context_.pool.for_each(int(vertices_.size()), kBands, [&](int v) { place(std::size_t(v), own); });
    std::erase_if(triangles_, [&](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return vertices_[v].kept == 0; });
    });
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const float most_mm = zones_.is_ear(vertices_mm_[v]) ? kEarSureMm : kSureMm;
      sure_.push_back(vertices_[v].measured != 0 && vertices_[v].sigma_mm <= most_mm ? 1 : 0);
    }
    placed_ = vertices_.size();
  }

  // False if nothing is left.
  bool trim_rims(const OwnFace& own) {
    trim(kHoleOpenedMm, 0);
    close_all(border_edges(triangles_, scratch_), false);
    // Once only the outline is left: tufts of hair, however sure, but no ears.
    for (std::size_t v = 0; v < sure_.size(); ++v) sure_[v] = sure_[v] && zones_.is_ear(vertices_mm_[v]);
    for (const float radius_mm : kOutlineOpenedMm) {
      trim(radius_mm, kEarHolds);
      if (triangles_.empty()) return false;
      const auto border = border_edges(triangles_, scratch_);
      smooth_rims(vertices_mm_, border, kRimRounds, kRimMoveMm, scratch_);
      for (const BorderEdge& e : border)
        if (e[0] < placed_) place(e[0], own);
      part_equals(vertices_mm_, started_, scratch_);
      close_all(border, true);
    }
    return !triangles_.empty();
  }

  // First what closes a hole, with the last of what was measured beside it; steps, but for those that eyes
  // and ears have; folds. Then what was completed or is unsure, where other poses begin to count.
  void lay_anew(bool has_steps) {
    std::pmr::vector<std::uint8_t> part(vertices_.size(), 0, scratch_);
    std::pmr::vector<std::uint8_t> stays(part, scratch_), label(part, scratch_), unsure(part, scratch_);
    std::fill(part.begin() + std::ptrdiff_t(placed_), part.end(), kClosedRings);
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      label[v] = v < placed_ ? vertices_[v].poses : kBetweenNothing;
      unsure[v] = vertices_[v].measured == 0 || vertices_[v].sigma_mm > kSureMm ? 1 : 0;
      const Vec3f& at = vertices_mm_[v];
      stays[v] = v < placed_ && !zones_.is_eye_rim(at) && (zones_.is_eye(at) || zones_.is_ear(at));
      if (zones_.is_eye_rim(at)) part[v] = std::max(part[v], kEyeRimRings);
    }
    for (const BorderEdge& e : border_edges(triangles_, scratch_)) stays[e[0]] = 1;
    {
      const Arena::Mark mark(context_.scratch);
      if (has_steps) add_steps(vertices_mm_, triangles_, label, part, scratch_);
      add_folds(vertices_mm_, triangles_, unsure, part, scratch_);
    }
    fair(part, stays);

    std::fill(part.begin(), part.end(), std::uint8_t{0});
    for (const Triangle& t : triangles_) {
      const bool guessed =
          std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return vertices_[v].measured == 0; });
      if (guessed && (label[t[0]] != label[t[1]] || label[t[0]] != label[t[2]]))
        for (const std::uint32_t v : t) part[v] = kUnsureRings;
    }
    // What was measured stays, but for the last of it.
    std::pmr::vector<std::uint8_t> last(vertices_.size(), 0, scratch_);
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (v >= placed_ || vertices_[v].poses == 0 || vertices_[v].measured == 0) last[v] = kLastRings + 1;
    spread_rings(triangles_, last);
    for (std::size_t v = 0; v < placed_; ++v)
      if (last[v] == 0) stays[v] = 1;
    fair(part, stays);

    const std::pmr::vector<Vec3f> before(vertices_mm_, scratch_);
    unfold(vertices_mm_, triangles_, scratch_);
    for (std::size_t v = 0; v < before.size(); ++v)
      if (const float mm = distance(before[v], vertices_mm_[v]); mm > 0)
        vertices_[v].sigma_mm = std::hypot(vertices_[v].sigma_mm, mm);
  }

  // In the context's output.
  FusedSurface packed() const {
    std::size_t closing = 0;
    std::pmr::vector<std::uint8_t> pose(&context_.output);
    pose.reserve(vertices_.size());
    FaceMesh mesh = pack_mesh(vertices_.size(), triangles_, context_, [&](std::size_t v) {
      pose.push_back(vertices_[v].pose);
      if (v < placed_) closing = pose.size();
      // What was laid anew by more than that is measured no longer.
      const bool sure = vertices_[v].sigma_mm <= float(kMeasuredSigmaMm);
      return PackedVertex{vertices_mm_[v], vertices_[v].sigma_mm,
                          sure ? vertices_[v].measured : std::uint8_t{0}};
    });
    mesh.pose = std::move(pose);
    compute_normals(mesh, 1, scratch_);
    return {std::move(mesh), closing};
  }

 private:
  struct Vertex {
    float sigma_mm = 0;
    std::uint8_t pose = 0, measured = 0, kept = 0;
    std::uint8_t poses = 0;  // that say where it lies, a bit each
  };

  void place(std::size_t v, const OwnFace& own) {
    Vec3f& at = vertices_mm_[v];
    if (const auto placed = blend_.settle(at, unit(normals_[v]))) {
      at = placed->at_mm;
      const bool sure = placed->sigma_mm <= float(kMeasuredSigmaMm);
      vertices_[v] = {placed->sigma_mm, placed->pose, sure ? std::uint8_t{1} : std::uint8_t{0}, 1,
                      placed->poses};
    } else if (const auto said = own.at(at)) {
      vertices_[v] = {said->sigma_mm, 0, said->measured ? std::uint8_t{1} : std::uint8_t{0}, 1};
    }
  }

  void trim(float radius_mm, int holds) {
    const Arena::Mark mark(context_.scratch);
    open_rims(vertices_mm_, sure_, triangles_, radius_mm, holds, scratch_);
    keep_one_surface(vertices_mm_, triangles_, {}, scratch_);
  }

  // Where an edge joins two vertices of a rim, nothing closes it: what lies around it goes, too, and the next
  // rim is rounder.
  void close_all(std::span<const BorderEdge> border, bool bays) {
    constexpr int kTimes = 4;
    auto open = close(border, bays);
    for (int time = 1; !open.empty() && time < kTimes; ++time) {
      std::sort(open.begin(), open.end());
      std::erase_if(triangles_, [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(),
                           [&](std::uint32_t v) { return std::ranges::binary_search(open, v); });
      });
      {
        const Arena::Mark mark(context_.scratch);
        keep_one_surface(vertices_mm_, triangles_, {}, scratch_);
      }
      open = close(border_edges(triangles_, scratch_), false);
    }
  }

  // What closes a hole was not measured. Returns the vertices of the rims that stay open.
  std::vector<std::uint32_t> close(std::span<const BorderEdge> border, bool bays) {
    const auto mouth_mm = [&](const Vec3f& headland) {
      if (!bays) return 0.0F;
      return zones_.is_throat(headland) ? kThroatMouthMm : kBayMouthMm;
    };
    ClosedHoles closed = close_holes(vertices_mm_, normals_, border, {kHoleRimMm, mouth_mm}, triangles_);
    for (const std::uint32_t v : closed.beside) {
      normals_.push_back(normals_[v]);
      vertices_.push_back({kClosedSigmaMm, vertices_[v].pose, 0, 1});
      started_.push_back(vertices_mm_[started_.size()]);
      sure_.push_back(0);
    }
    return std::move(closed.left_open);
  }

  void fair(std::span<const std::uint8_t> part, std::span<const std::uint8_t> stays) {
    const Arena::Mark mark(context_.scratch);
    const auto moved = fair_part(vertices_mm_, triangles_, part, stays, scratch_);
    for (std::size_t v = 0; v < moved.size(); ++v)
      vertices_[v].sigma_mm = std::hypot(vertices_[v].sigma_mm, moved[v]);
  }

  std::pmr::vector<Vec3f> vertices_mm_;
  std::pmr::vector<Triangle> triangles_;
  const PoseBlend& blend_;
  const HeadZones& zones_;
  StageContext& context_;
  std::pmr::memory_resource* scratch_{&context_.scratch};
  std::pmr::vector<Vertex> vertices_{scratch_};
  std::pmr::vector<Vec3f> started_{scratch_};  // where the field had them
  std::pmr::vector<Vec3f> normals_{scratch_};
  std::pmr::vector<std::uint8_t> sure_{scratch_};
  std::size_t placed_ = 0;  // vertices before those that close holes
};

}  // namespace

Result<FusedSurface> HeadFuser::fuse(std::span<HeadPose> poses, const Registration& registration,
                                     const FaceMesh& face, const Landmarks& landmarks,
                                     StageContext& context) const {
  RELIEVO_TRY(check_options(*this, "averaged"));
  const HeadZones zones(landmarks, poses[0].head_from_camera, neck_mm);
  drop_hair(poses, registration, zones);
  const bool calibrations_differ = disagree(registration);
  bend_to_master(poses, registration, *this, !calibrations_differ, context);
  // Wider than for registration, and after hair and what moved too far went: no step where a surface ends.
  for (HeadPose& pose : poses) fade_to_edges(pose, kEdgeNodes, &context.scratch);
  if (context.stop()) return stopped();
  const PoseBlend blend(poses, registration, zones, context);
  std::pmr::vector<FieldPoint> points = blend.points(float(voxel_mm));
  if (points.empty()) return no_surface();
  const auto own_vertices = add_own(face, poses[0].head_from_camera, zones, blend, points);
  if (context.stop()) return stopped();

  std::pmr::vector<Vec3f> places(&context.scratch);
  places.reserve(points.size());
  for (const FieldPoint& s : points) places.push_back(s.at_mm);
  BandVolume volume = volume_around(places, float(voxel_mm), 4, &context.scratch);
  fill_field(points, kBandVoxels * volume.voxel_mm, volume, context);
  if (context.stop()) return stopped();
  Surface surface(polygonise(volume, &context.scratch), blend, zones, context);
  OwnFace own(std::move(volume));
  for (const std::uint32_t v : own_vertices)
    own.mark(face.vertices_mm[v], face.sigma_mm[v], face.measured[v] != 0);
  if (context.stop()) return stopped();
  surface.place(own);
  if (!surface.trim_rims(own)) return no_surface();
  if (context.stop()) return stopped();
  surface.lay_anew(calibrations_differ);
  return surface.packed();
}

}  // namespace relievo::pipeline
