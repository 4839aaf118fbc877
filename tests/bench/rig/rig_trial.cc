// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/rig/rig_trial.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "firmware/measure/measurement.h"
#include "hal/sim/render.h"
#include "pipeline/pipeline.h"
#include "tests/support/rig_calibration.h"

namespace relievo::bench {
namespace {

namespace sim = hal::sim;
using firmware::measure::Surface;
using firmware::measure::TriangleGrid;
using sim::Vec3;

constexpr double kFaceRadiusMm = 95;  // the crop of 3D face recognition, as `relievo compare` has it
constexpr double kHalfMm = 0.5, kReachMm = 3;
constexpr double kBesideMm = 0.5;  // the model's border is no surface for what lies beyond it
constexpr double kViewerMm = 600;

// The rig's middle looks along z: where the left camera's frame stands in that frame is what make_rig does.
struct Middle {
  Vec3 origin_mm, forward, right;
  explicit Middle(const sim::SimRig& rig, double half_toe) {
    origin_mm = rig.right.centre() * 0.5;
    forward = {-std::sin(half_toe), 0, std::cos(half_toe)};
    right = {std::cos(half_toe), 0, std::sin(half_toe)};
  }
};

sim::RigOptions options_of(const RigUnderTest& r, std::uint32_t seed, double scale) {
  sim::RigOptions o;
  o.width_px = static_cast<int>((r.portrait ? 1200 : 1920) * scale);
  o.height_px = static_cast<int>((r.portrait ? 1920 : 1200) * scale);
  o.focal_px = r.focal_px;
  o.baseline_mm = r.baseline_mm;
  o.convergence_mm = r.toe_in > 1e-6 ? r.distance_mm / r.toe_in : 1e7;
  o.seed = seed;
  return o;
}

// HeadPose counts from the left camera's axes; yaw + turns to the picture's right.
sim::HeadPose pose_of(const RigUnderTest& r, const Stand& s, const sim::SimRig& rig, double half_toe) {
  const Middle middle(rig, half_toe);
  const Vec3 at = middle.origin_mm + middle.forward * (r.distance_mm + s.back_mm) +
                  middle.right * s.right_mm + Vec3{0, s.down_mm, 0};
  sim::HeadPose pose;
  pose.yaw_deg = half_toe * 180 / 3.14159265358979323846 + s.yaw_deg;
  pose.pitch_deg = s.pitch_deg;
  pose.roll_deg = s.roll_deg;
  pose.distance_mm = at.z;
  pose.right_mm = at.x;
  pose.down_mm = at.y;
  return pose;
}

// Where the person stands, for cameras that are asked what they see of them.
class Standing {
 public:
  Standing(const Person& person, const sim::HeadPose& pose)
      : person_(person),
        world_from_head_(pose.world_from_head()),
        origin_(pose.origin_mm()),
        frontal_from_head_(person.frontal.world_from_head()),
        frontal_origin_(person.frontal.origin_mm()) {}
  Vec3 at_mm(const Person::Sample& s) const { return world_from_head_ * s.at_mm + origin_; }
  Vec3 normal(const Person::Sample& s) const { return world_from_head_ * s.normal; }

  bool seen_by(const sim::SimView& view, const Person::Sample& s) const {
    const Vec3 p = at_mm(s);
    if (dot(world_from_head_ * s.normal, view.centre() - p) <= 0 || view.depth_mm(p) < 50) return false;
    const sim::Pixel q = view.project(p);
    if (q.x < 2 || q.y < 2 || q.x > view.width_px - 3 || q.y > view.height_px - 3) return false;
    const Vec3 camera =
        frontal_from_head_ * (world_from_head_.transposed() * (view.centre() - origin_)) + frontal_origin_;
    const Vec3 from = frontal_from_head_ * (s.at_mm + s.normal * 0.15) + frontal_origin_, to = camera - from;
    const double far = length(to);
    return !person_.scene->blocked(from, to * (1 / far), far);
  }

 private:
  const Person& person_;
  sim::Mat3 world_from_head_;
  Vec3 origin_;
  sim::Mat3 frontal_from_head_;
  Vec3 frontal_origin_;
};

Surface measured_surface(const pipeline::FaceMesh& mesh) {
  Surface surface;
  surface.vertices_mm.assign(mesh.vertices_mm.begin(), mesh.vertices_mm.end());
  for (const auto& t : mesh.triangles)
    if (mesh.measured[t[0]] != 0 && mesh.measured[t[1]] != 0 && mesh.measured[t[2]] != 0)
      surface.triangles.push_back(t);
  return surface;
}

Result<Surface> reconstruct(const sim::PicturePair& pictures, const sim::SimRig& rig, const RigUnderTest& r,
                            test::StageFixture& room) {
  room.output.reset();
  // The volume follows the distance: nose to ear, and how people stand.
  const pipeline::RectifierOptions volume{r.distance_mm - 160, r.distance_mm + 190, 8192};
  RELIEVO_TRY_ASSIGN(const auto stages, pipeline::Pipeline::make({}, test::true_calibration(rig), volume));
  RELIEVO_TRY_ASSIGN(auto pair, stages.rectify({pictures.left.view(), pictures.right.view()}, room.context));
  RELIEVO_TRY_ASSIGN(const auto matches, stages.match(pair, room.context));
  RELIEVO_TRY_ASSIGN(const auto cloud, stages.reconstruct(pair, matches, room.context));
  RELIEVO_TRY_ASSIGN(const auto mesh, stages.mesh(cloud, pair, room.context));
  return measured_surface(mesh);
}

double weighted_percentile(std::vector<std::pair<double, double>>& values, double share) {
  std::sort(values.begin(), values.end());
  double total = 0, sum = 0;
  for (const auto& v : values) total += v.second;
  for (const auto& v : values)
    if ((sum += v.second) >= share * total) return v.first;
  return std::nan("");
}

// The rig and the pose that a stand before it means.
struct Setting {
  sim::SimRig rig;
  sim::HeadPose pose;
  Setting(const RigUnderTest& r, const Stand& stand, std::uint32_t seed, double scale) {
    const sim::RigOptions options = options_of(r, seed, scale);
    rig = sim::make_rig(options);
    pose = pose_of(r, stand, rig, std::atan(r.baseline_mm / 2 / options.convergence_mm));
  }
};

}  // namespace

Person make_person(std::uint32_t seed, ThreadPool& pool) {
  Person person;
  person.head = sim::make_head(sim::traits_of(seed), pool);
  person.frontal.distance_mm = kViewerMm;
  person.scene = sim::make_head_scene(person.head, person.frontal, pool);
  const sim::Mat3 head_from_world = person.frontal.world_from_head().transposed();
  Vec3 nose{0, 0, 1e9};
  struct Seen {
    sim::SolidPoint solid;
    double area;
  };
  std::vector<Seen> seen;
  constexpr double kStep = 1.5 / kViewerMm;
  for (double v = -0.28; v < 0.28; v += kStep)
    for (double u = -0.2; u < 0.2; u += kStep) {
      const Vec3 ray = sim::normalised(Vec3{u, v, 1});
      sim::SolidPoint s;
      if (!person.scene->solid({0, 0, 0}, ray, s) || !s.skin) continue;
      const double slope = std::abs(dot(s.normal, ray));
      if (slope < 0.17) continue;  // steeper than 80 degrees: the weight would explode
      seen.push_back({s, dot(s.point, s.point) / slope});
      if (s.point.z < nose.z) nose = s.point;
    }
  for (const Seen& s : seen)
    if (length(s.solid.point - nose) < kFaceRadiusMm)
      person.face.push_back({head_from_world * (s.solid.point - person.frontal.origin_mm()),
                             head_from_world * s.solid.normal, s.area});
  return person;
}

TrialResult look_at(const RigUnderTest& r, const Person& person, const Stand& stand, std::uint32_t seed) {
  const Setting setting(r, stand, seed, 1);
  const Standing standing(person, setting.pose);
  double total = 0, both = 0;
  for (const Person::Sample& s : person.face) {
    total += s.area;
    if (standing.seen_by(setting.rig.left, s) && standing.seen_by(setting.rig.right, s)) both += s.area;
  }
  TrialResult result;
  result.seen_by_both = both / total;
  return result;
}

TrialResult run_trial(const RigUnderTest& r, const Person& person, const Stand& stand, std::uint32_t seed,
                      double scale, test::StageFixture& room) {
  const Setting setting(r, stand, seed, scale);
  const auto scene = sim::make_head_scene(person.head, setting.pose, room.pool);
  const auto model =
      reconstruct(sim::render_pair(*scene, setting.rig, {}, seed, room.pool), setting.rig, r, room);
  TrialResult result;
  result.done = model.has_value();
  if (!model) result.why = model.error().what.view();
  const std::optional<TriangleGrid> grid = model ? std::optional<TriangleGrid>(*model) : std::nullopt;
  const Standing standing(person, setting.pose);
  double total = 0, both = 0, matched = 0, good = 0;
  std::vector<std::pair<double, double>> errors;
  for (const Person::Sample& s : person.face) {
    const Vec3 p = standing.at_mm(s);
    total += s.area;
    const bool seen = standing.seen_by(setting.rig.left, s) && standing.seen_by(setting.rig.right, s);
    if (seen) both += s.area;
    const auto near = grid ? grid->nearest({p.x, p.y, p.z}, kReachMm) : std::nullopt;
    if (!near) continue;
    const double error =
        std::abs(dot(standing.normal(s), Vec3{near->at_mm.x, near->at_mm.y, near->at_mm.z} - p));
    if (std::sqrt(std::max(0.0, near->distance_mm * near->distance_mm - error * error)) >
        kBesideMm + 0.5 * error)
      continue;
    if (error < kHalfMm) good += s.area;
    if (!seen) continue;
    matched += s.area;
    errors.emplace_back(error, s.area);
  }
  result.seen_by_both = both / total;
  result.within_half_mm = good / total;
  result.matched = both > 0 ? matched / both : 0;
  result.median_mm = weighted_percentile(errors, 0.5);
  result.p95_mm = weighted_percentile(errors, 0.95);
  return result;
}

}  // namespace relievo::bench
