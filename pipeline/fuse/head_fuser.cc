// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_fuser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/fuse/fairing.h"
#include "pipeline/fuse/head_zones.h"
#include "pipeline/fuse/own_face.h"
#include "pipeline/fuse/rim.h"
#include "pipeline/fuse/skin_bender.h"
#include "pipeline/mesh/mesher.h"
#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kDownward = -0.6;        // cosine to upwards
constexpr double kDenseVoxels = 0.6;      // apart, or less
constexpr float kBandVoxels = 2.5F;       // how far from a point the field reaches
constexpr float kCompletedShare = 0.02F;  // of a measured point's weight
constexpr float kDisagreeSigmas = 4;
constexpr float kDisagreeMm = 0.4F;  // what lies closer is the same skin
constexpr float kSameWay = 0.3F;     // cosine: a surface that faces elsewhere is another one
constexpr float kReachMm = 1.2F;     // of a pose's surface from a vertex that is placed on it
constexpr float kLeastSigmaMm = 0.005F;
constexpr float kFullTrust = 0.95F;
constexpr float kLeastTrust = 0.005F;           // of a point that counts at all
constexpr float kEdgeNodes = 16;                // over which a pose's weight fades
constexpr int kTuftEdges = 12, kEarHolds = 25;  // an ear that hangs on by less is a rag between hair
constexpr int kRimEdges = 8, kRimRounds = 20;   // what is opened, how often rims are straightened ...
constexpr float kSureMm = 0.15F;                // skin; hair that was half seen through is less certain
constexpr float kRimMoveMm = 0.7F;              // ... and by how much at most
constexpr std::uint8_t kClosedRings = 3, kUnsureRings = 9, kLastRings = 3, kEyeRimRings = 1;
constexpr float kHoleRimMm = 400, kBayMouthMm = 25, kClosedSigmaMm = 1;  // of holes and bays that are closed
constexpr int kBands = 32;

class Fusion {
 public:
  Fusion(std::span<const PoseSurface> poses, const Registration& registration, const HeadZones& zones,
         StageContext& context)
      : poses_(poses),
        registration_(registration),
        zones_(zones),
        context_(context),
        back_(&context.scratch) {
    for (const RegisteredPose& p : registration.poses) back_.push_back(inverse(p.first_from_pose));
  }

  // What pose k shows at a place of the master's frame, in that frame.
  std::optional<SurfaceHit> look(std::size_t k, const Vec3f& place) const {
    auto hit = poses_[k].look(narrow(apply(back_[k], wide(place))));
    if (!hit || hit->trust <= kLeastTrust) return std::nullopt;
    hit->trust = (hit->trust - kLeastTrust) / (1 - kLeastTrust) * (k == 0 ? 1 : zones_.others_share(place));
    const RigidTransform& placed = registration_.poses[k].first_from_pose;
    hit->at_mm = narrow(apply(placed, wide(hit->at_mm)));
    hit->normal = narrow(apply(placed.rotation, wide(hit->normal)));
    return hit;
  }

  bool is_seen_near(const Vec3f& place) const {
    constexpr float kNearMm = 15;
    for (std::size_t k = 0; k < poses_.size(); ++k)
      if (const auto hit = look(k, place); hit && distance(hit->at_mm, place) < kNearMm) return true;
    return false;
  }

  // The points that count, of all poses; where they lie closer than the field tells apart, every other one.
  std::pmr::vector<FieldPoint> choose(float voxel_mm) const {
    std::pmr::vector<FieldPoint> all(&context_.scratch);
    std::size_t room = 0;
    for (const PoseSurface& p : poses_) room += p.at_mm.size();
    all.reserve(room);
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      const PoseSurface& pose = poses_[k];
      const RigidTransform& placed = registration_.poses[k].first_from_pose;
      const std::size_t first = all.size(), columns = std::size_t(pose.columns);
      const auto dense_mm = float(kDenseVoxels * pose.focal_px / pose.step_px) * voxel_mm;
      all.resize(first + pose.at_mm.size());  // weight 0: does not count
      context_.pool.for_each_band(int(pose.at_mm.size()), kBands, [&](int from, int to, int) {
        for (auto i = std::size_t(from); i < std::size_t(to); ++i) {
          if (pose.trust[i] < kLeastTrust) continue;
          if (pose.at_mm[i].z < dense_mm && (i % columns + i / columns) % 2 != 0) continue;
          const Vec3f at = narrow(apply(placed, wide(pose.at_mm[i])));
          if (!zones_.is_head(at) || zones_.is_eye(at)) continue;
          const Vec3f normal = narrow(apply(placed.rotation, wide(pose.normal[i])));
          const float trust = pose.trust[i] * (k == 0 ? 1 : zones_.others_share(at));
          if (!overruled(k, at, normal, pose.sigma_mm[i], trust))
            all[first + i] = {at, normal, trust / squared(std::max(pose.sigma_mm[i], kLeastSigmaMm))};
        }
      });
      all.erase(std::remove_if(all.begin() + std::ptrdiff_t(first), all.end(),
                               [](const FieldPoint& p) { return p.weight <= 0; }),
                all.end());
    }
    return all;
  }

  // Moves a vertex onto the mean of what the poses show; none where no pose shows anything there.
  struct Placed {
    Vec3f at_mm;
    float sigma_mm;
    std::uint8_t pose;
    std::uint8_t poses;  // a bit each
  };
  std::optional<Placed> settle(Vec3f at, const Vec3f& normal) const {
    if (zones_.is_eye(at)) return std::nullopt;
    std::optional<Placed> placed;
    for (int round = 0; round < 2; ++round) {
      const auto moved = step(at, normal);
      if (!moved) return placed;
      placed = moved;
      at = placed->at_mm;
    }
    return placed;
  }

 private:
  static float squared(float x) { return x * x; }
  // How far two surfaces may lie apart that are taken for the same skin, if that is as unsure.
  static float allowed_mm(float sigma_mm) {
    return std::clamp(kDisagreeSigmas * sigma_mm, kDisagreeMm, kReachMm);
  }

  // What a pose shows at a vertex.
  struct Seen {
    float distance = 0, weight = 0, certainty = 0, trust = 0;
    Vec3f normal{};
  };

  std::optional<Placed> step(const Vec3f& at, const Vec3f& normal) const {
    std::array<Seen, kMostPoses> seen{};
    std::size_t best = poses_.size();
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      const auto hit = look(k, at);
      if (!hit || dot(hit->normal, normal) < kSameWay) continue;
      const float d = dot(hit->normal, minus(at, hit->at_mm));
      if (std::abs(d) > 2 * kReachMm) continue;
      const float certainty = 1 / squared(std::max(hit->sigma_mm, kLeastSigmaMm));
      seen[k] = {d, hit->trust * certainty, certainty, hit->trust, hit->normal};
      if (std::abs(d) > kReachMm) continue;
      if (best == poses_.size() ||
          rank(k, seen[k].trust, seen[k].weight) > rank(best, seen[best].trust, seen[best].weight))
        best = k;
    }
    if (best == poses_.size()) return std::nullopt;
    return mean_of(seen, best, at, normal);
  }

  // What disagrees with the one that counts most is other skin, or skin that moved: its weight fades, so that
  // no step is left where one begins to disagree; less so where that one fades itself, so that none is left
  // where another takes its place.
  Placed mean_of(std::array<Seen, kMostPoses>& seen, std::size_t best, const Vec3f& at,
                 const Vec3f& normal) const {
    // A surface that fades out is no surer at its end than the others, else they would take its place at
    // once.
    float least = seen[best].certainty;
    for (const Seen& s : seen)
      if (s.weight > 0) least = std::min(least, s.certainty);
    Vec3f pull{};
    float weight = 0, variance = 0;
    std::size_t most = best;
    unsigned poses = 0;
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      Seen& s = seen[k];
      if (s.weight <= 0) continue;
      const float sigma = std::sqrt(1 / s.certainty + 1 / seen[best].certainty);
      const float off = std::abs(s.distance - seen[best].distance) / allowed_mm(sigma);
      s.weight = s.trust * least * std::pow(s.certainty / least, s.trust);
      const float trusted = best == 0 ? (1 - seen[0].trust) / 0.75F : 2 * s.trust / seen[best].trust - 0.5F;
      s.weight *= k == best ? 1 : std::clamp(std::max(2 - 2 * off, trusted), 0.0F, 1.0F);
      pull = along(pull, s.weight * s.distance, s.normal);
      weight += s.weight;
      variance += s.weight * s.weight * (1 / s.certainty);
      if (s.weight > seen[most].weight) most = k;
      if (s.weight > 0) poses |= 1U << k;
    }
    const Vec3f there = along(at, -1 / weight, pull);
    const float registered = float(registration_sigma(most, there, normal));
    return {there, std::sqrt(variance / squared(weight) + squared(registered)), std::uint8_t(most),
            std::uint8_t(poses)};
  }

  // The master where it sees well; else whoever is surest.
  static float rank(std::size_t k, float trust, float weight) {
    return k == 0 && trust >= kFullTrust ? std::numeric_limits<float>::max() : weight;
  }

  // Another pose that counts for more shows the skin elsewhere.
  bool overruled(std::size_t k, const Vec3f& at, const Vec3f& normal, float sigma, float trust) const {
    const float mine = rank(k, trust, trust / squared(std::max(sigma, kLeastSigmaMm)));
    for (std::size_t j = 0; j < poses_.size(); ++j) {
      if (j == k) continue;
      const auto hit = look(j, at);
      if (!hit || dot(hit->normal, normal) < kSameWay) continue;
      if (rank(j, hit->trust, hit->trust / squared(std::max(hit->sigma_mm, kLeastSigmaMm))) <= mine) continue;
      const float d = std::abs(dot(hit->normal, minus(at, hit->at_mm)));
      constexpr float kOtherMm = 6;  // further behind or before it lies something else
      if (d < kOtherMm && d > allowed_mm(std::hypot(sigma, hit->sigma_mm))) return true;
    }
    return false;
  }

  // Of a place, perpendicular to the surface.
  double registration_sigma(std::size_t k, const Vec3f& at, const Vec3f& normal) const {
    if (k == 0) return 0;
    const Vec3d n = wide(normal), turn = cross(minus(wide(at), registration_.pivot_mm), n);
    const std::array<double, 6> j{turn.x, turn.y, turn.z, n.x, n.y, n.z};
    double variance = 0;
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b)
        variance += j[a] * j[b] * registration_.poses[k].covariance[6 * a + b];
    return std::sqrt(std::max(variance, 0.0));
  }

  std::span<const PoseSurface> poses_;
  const Registration& registration_;
  const HeadZones& zones_;
  StageContext& context_;
  std::pmr::vector<RigidTransform> back_;
};

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
  const Fusion fusion(poses, registration, zones, context);
  std::pmr::vector<FieldPoint> points = fusion.choose(float(options_.voxel_mm));
  if (points.empty()) return no_surface();
  // The master's eyes, and what its mesher completed: about nose and mouth for where no pose measured,
  // further out where none shows anything near, for there the sides know better. Of ears
  // and of what lies below a chin it knows nothing.
  std::pmr::vector<std::uint32_t> own(&context.scratch);
  for (std::uint32_t v = 0; v < face.vertices_mm.size(); ++v) {
    const Vec3f& at = face.vertices_mm[v];
    const bool below = apply(poses[0].head_from_camera.rotation, wide(face.normals[v])).y < kDownward;
    const bool beside = !below && !zones.is_ear(at) && !fusion.is_seen_near(at);
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
    if (const auto placed = fusion.settle(at, normal)) {
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
  for (const Vertex& v : vertices) sure.push_back(v.measured != 0 && v.sigma_mm <= kSureMm ? 1 : 0);
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
  open_rims(sure, surface.triangles, kRimEdges, 0, &context.scratch);
  keep_one_surface(surface.vertices_mm, surface.triangles, {}, &context.scratch);
  close(border_edges(surface.triangles, &context.scratch), 0);
  // Once only the outline is left: tufts of hair, however sure, but no ears.
  for (std::size_t v = 0; v < sure.size(); ++v) sure[v] = sure[v] && zones.is_ear(surface.vertices_mm[v]);
  open_rims(sure, surface.triangles, kTuftEdges, kEarHolds, &context.scratch);
  keep_one_surface(surface.vertices_mm, surface.triangles, {}, &context.scratch);
  if (surface.triangles.empty()) return no_surface();

  auto border = border_edges(surface.triangles, &context.scratch);
  smooth_rims(surface.vertices_mm, border, kRimRounds, kRimMoveMm, &context.scratch);
  for (const BorderEdge& e : border) settle(e[0], unit(normals[e[0]]));
  part_equals(surface.vertices_mm, started, &context.scratch);
  close(border, kBayMouthMm);

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
