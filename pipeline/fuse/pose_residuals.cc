// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_residuals.h"

#include <limits>

#include "hal/base/statistics.h"

namespace relievo::pipeline {
namespace {

constexpr double kLeastScaleMm = 0.05;
constexpr double kPatchMm = 20;
constexpr double kLeastSlideScaleMm = 0.2;
constexpr double kFaceMovesMore = 3;  // by so much, beyond noise
constexpr double kNothingMovesMm = 0.02, kMostMovesMm = 0.1, kCalibrationsDifferMm = 0.15;

bool slides(const PatchMean& mean) { return mean.patch >= SkinPatches::kPatches; }

// Head frame.
Vec3d middle_of(std::size_t patch) {
  const auto middle = [](std::size_t cell) {
    return (double(cell) - SkinPatches::kAcross / 2 + 0.5) * kPatchMm;
  };
  return {middle(patch % SkinPatches::kAcross), middle(patch / SkinPatches::kAcross % SkinPatches::kAcross),
          middle(patch / SkinPatches::kAcross / SkinPatches::kAcross) - kHeadCentreMm};
}

// How much a patch that lies so far off has to say, 0 to 1; one that lies off by the scale keeps a quarter of
// its say.
double still(double mean_mm, double scale_mm) {
  const double kept = scale_mm * scale_mm / (scale_mm * scale_mm + mean_mm * mean_mm);
  return kept * kept;
}

// Below the forehead and before the temples.
bool is_face(std::size_t patch) {
  const Vec3d middle = middle_of(patch % SkinPatches::kPatches);
  return middle.z > -62 && middle.y < 52;
}

// Where skin moves, a patch that was measured better says hardly more (random effects: DerSimonian, Laird
// 1986); a face moves more than what is around it.
double weight_of(const PatchMean& mean, double usual_mm) {
  double moves = usual_mm;
  if (is_face(mean.patch))
    moves += kFaceMovesMore * std::clamp(usual_mm - kNothingMovesMm, 0.0, kMostMovesMm);
  return mean.weight / (1 + mean.weight * moves * moves);
}

// One standard deviation while a face moves by half a millimetre. Ears and what is behind the temples hang on
// the skull. Where all of the skin lies off it has not moved: calibrations differ.
double slides_mm(std::size_t patch, double usual_mm) {
  const Vec3d middle = middle_of(patch % SkinPatches::kPatches);
  if (middle.z < -100) return 0.08;
  if (middle.z < -70) return 0.18;
  if (is_face(patch) && usual_mm < kCalibrationsDifferMm) return 1;
  return middle.y > 110 ? 0.15 : 0.35;
}

constexpr double kSameFacing = 0.7;  // cosine between the normals of what is taken for the same skin
constexpr double kSurfaceSigmaMm = 0.03;
constexpr double kNeckMm = -60;  // above the tip of the nose
constexpr double kScaleOfUsual = 1.5;

double say_in_head(const Vec3d& p) {
  const double side = std::abs(p.x);
  if (p.y < kNeckMm) return 0;                // neck
  if (p.y > 105) return 0.1;                  // hair
  if (p.z < -62) return p.y < -30 ? 0.1 : 1;  // temples, ears; the jaw's corner
  if (p.y > 52) return 1;                     // forehead
  if (side < 9 && p.y > 12) return 1;         // bridge of the nose
  if (p.y > 20 && side < 60) return 0.05;     // lids and brows
  if (p.y > 0) return side > 30 ? 0.3 : 0.1;  // cheek bones
  return 0.02;                                // lips, chin, jaw
}

constexpr double kMeetMm = 3;        // a surface further off is another one
constexpr double kMeetFacing = 0.6;  // cosine between the normals of what is taken for the same skin
constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

// By how much a place of pose `a` lies before what pose `b` shows there.
float distance_mm(const Vec3d& at, const Vec3d& normal, const HeadPose& b, const RigidTransform& placed) {
  const auto hit = look(b, placed, at);
  if (!hit || hit->own.trust < PoseResiduals::kLeastTrust) return kNowhere;
  return dot(hit->normal, normal) < kMeetFacing || std::abs(hit->before_mm) > kMeetMm ? kNowhere
                                                                                      : float(hit->before_mm);
}

PoseMeeting meeting_of(std::pmr::vector<float>& distances, double area_mm2) {
  if (distances.empty()) return {};
  double squares = 0;
  for (float& d : distances) {
    squares += double(d) * double(d);
    d = std::abs(d);
  }
  return {area_mm2, std::sqrt(squares / double(distances.size())), percentile(distances, 0.95)};
}

// Of one pose with the others.
void measure_agreement_of(std::size_t a, std::span<const HeadPose> poses, Registration& registration,
                          SharedArena& memory) {
  const HeadPose& pose = poses[a];
  const RigidTransform& placed = registration.poses[a].first_from_pose;
  ResidualMap& map = registration.residuals[a];
  std::array<double, kMostPoses> area_mm2{};
  std::pmr::vector<std::pmr::vector<float>> distances(poses.size(), &memory);
  for (std::size_t b = 0; b < poses.size(); ++b)
    if (b != a) distances[b].reserve(map.mm.size());
  for (std::size_t i = 0; i < map.mm.size(); ++i) {
    const std::size_t k = i / std::size_t(map.columns) * kResidualEvery * std::size_t(pose.columns) +
                          i % std::size_t(map.columns) * kResidualEvery;
    const SurfaceHit& node = pose.nodes[k];
    if (node.trust < PoseResiduals::kLeastTrust) continue;
    const Vec3d at = apply(placed, wide(node.at_mm)), normal = apply(placed.rotation, wide(node.normal));
    const double side_mm = kResidualEvery * pose.step_px * double(node.at_mm.z) / pose.focal_px;
    const double cosine = std::abs(double(dot(node.normal, unit(node.at_mm))));
    float sum = 0, count = 0;
    for (std::size_t b = 0; b < poses.size(); ++b) {
      if (b == a) continue;
      const float d = distance_mm(at, normal, poses[b], registration.poses[b].first_from_pose);
      if (std::isnan(d)) continue;
      distances[b].push_back(d);
      area_mm2[b] += side_mm * side_mm / std::max(cosine, 0.1);
      sum += d, ++count;
    }
    if (count > 0) map.mm[i] = sum / count;
  }
  for (std::size_t b = 0; b < poses.size(); ++b)
    registration.poses[a].meets[b] = meeting_of(distances[b], area_mm2[b]);
}

}  // namespace

std::size_t SkinPatches::at(const Vec3d& in_head) {
  const auto cell = [](double x) {
    return std::size_t(std::clamp(int(std::floor(x / kPatchMm)) + kAcross / 2, 0, kAcross - 1));
  };
  return (cell(in_head.z + kHeadCentreMm) * kAcross + cell(in_head.y)) * kAcross + cell(in_head.x);
}

std::size_t SkinPatches::region_of(std::size_t patch) {
  const std::size_t x = patch % kAcross, y = patch / kAcross % kAcross, z = patch / kAcross / kAcross;
  return ((z / 2) * (kAcross / 2) + y / 2) * (kAcross / 2) + x / 2;
}

SkinPatches::Usual SkinPatches::usual(std::span<const PatchMean> means, std::pmr::memory_resource& memory) {
  const auto deviation = [&](bool sliding) {
    std::pmr::vector<double> off(&memory);
    for (const PatchMean& m : means)
      if (slides(m) == sliding) off.push_back(std::abs(m.mm));
    return off.empty() ? 0 : median(off) / 0.6745;
  };
  return {deviation(false), deviation(true)};
}

double SkinPatches::say(const PatchMean& mean, const Usual& usual) {
  if (slides(mean)) {
    const double mm = slides_mm(mean.patch, usual.off_mm);
    return still(mean.mm, std::max(kLeastSlideScaleMm, usual.slid_mm)) / (1 + mean.weight * mm * mm);
  }
  return still(mean.mm, std::max(kLeastScaleMm, usual.off_mm)) * weight_of(mean, usual.off_mm) / mean.weight;
}

void SkinPatches::take(std::span<const PatchMean> means) {
  const Usual usually = usual(means, *say_.get_allocator().resource());
  // Not robustly, as where the skulls stand is found: what moved is part of how unsure that is.
  double squares = 0, weights = 0;
  for (const PatchMean& m : means) {
    if (slides(m)) continue;
    const double weight = weight_of(m, usually.off_mm);
    squares += weight * m.mm * m.mm;
    weights += weight;
  }
  variance_mm2_ = weights > 0 ? squares / weights / 2 : 0;
  say_.assign(kPatches * poses_ * poses_, 1.0F);
  for (const PatchMean& m : means)
    if (!slides(m)) say_[between(m.patch, m.a, m.b)] = float(say(m, usually));
}

void PoseResiduals::move(std::size_t pose, const Vec3d& rotation, const Vec3d& translation_mm) {
  RigidTransform& placed = placed_[pose].first_from_pose;
  placed = product(small_motion(rotation, translation_mm, pivot_), placed);
}

std::array<Vec3d, 2> PoseResiduals::along_skin(const Vec3d& normal) const {
  const Vec3d head_up = apply(transposed(poses_[0].head_from_camera.rotation), Vec3d{0, 1, 0});
  const Vec3d up = unit(minus(head_up, times(normal, dot(head_up, normal))));
  return {cross(up, normal), up};
}

std::size_t PoseResiduals::patch_at(const Vec3d& place) const {
  return SkinPatches::at(apply(poses_[0].head_from_camera, place));
}

double PoseResiduals::say_of(PoseResidual& res) const {
  const Vec3d in_head = apply(poses_[0].head_from_camera, res.at);
  res.patch = SkinPatches::at(in_head);
  if (skin_.watched()) return in_head.y < kNeckMm ? 0 : 1;
  return say_in_head(in_head);
}

bool PoseResiduals::meet(std::size_t a, std::size_t k, const Vec3d& normal, std::size_t b,
                         const RegistrationRound& round, PoseResidual& res) const {
  const auto hit = look(poses_[b], placed_[b].first_from_pose, res.at);
  if (!hit || hit->own.trust < kLeastTrust) return false;
  const Vec3d& n = hit->normal;
  if (dot(n, normal) < kSameFacing) return false;
  res.value = hit->before_mm;
  if (std::abs(res.value) > round.reach_mm) return false;
  const HeadPose& from = poses_[a];
  const double sigma = double(from.nodes[k].sigma_mm), other = double(hit->own.sigma_mm);
  const double scale = std::max(round.scale_mm, kScaleOfUsual * usual_mm_);
  const double kept = scale * scale / (scale * scale + res.value * res.value);
  res.weight = double(std::min(from.nodes[k].trust, hit->own.trust)) * kept * kept /
               (sigma * sigma + other * other + kSurfaceSigmaMm * kSurfaceSigmaMm);
  const Vec3d turn = cross(minus(res.at, pivot_), n);
  res.toward << turn.x, turn.y, turn.z, n.x, n.y, n.z;
  return true;
}

std::optional<double> PoseResiduals::before_mm(const Vec3d& at, std::size_t b) const {
  const Vec3f place = narrow(apply(inverse(placed_[b].first_from_pose), at));
  const auto hit = poses_[b].look(place);
  if (!hit || hit->trust < kLeastTrust) return std::nullopt;
  return length(hit->at_mm) - length(place);
}

void measure_agreement(std::span<const HeadPose> poses, Registration& registration, StageContext& context) {
  for (const HeadPose& pose : poses) {
    ResidualMap& map = registration.residuals.emplace_back(&context.output);
    map.columns = (pose.columns + kResidualEvery - 1) / kResidualEvery;
    map.rows = (pose.rows + kResidualEvery - 1) / kResidualEvery;
    map.mm.assign(std::size_t(map.columns) * std::size_t(map.rows), kNowhere);
  }
  SharedArena memory(context.scratch);
  context.pool.for_each<std::size_t>(int(poses.size()), int(poses.size()), [&](std::size_t a) {
    measure_agreement_of(a, poses, registration, memory);
  });
}

}  // namespace relievo::pipeline
