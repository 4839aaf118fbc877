// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_blend.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/base/statistics.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kDenseVoxels = 0.6;  // apart, or less
constexpr float kDisagreeSigmas = 4;
constexpr float kDisagreeMm = 0.4F;  // what lies closer is the same skin
constexpr float kSameWay = 0.3F;     // cosine: a surface that faces elsewhere is another one
constexpr float kReachMm = 1.2F;     // of a pose's surface from a vertex that is placed on it
constexpr float kLeastSigmaMm = 0.005F;
constexpr float kFullTrust = 0.95F;
constexpr float kLeastTrust = 0.005F;  // of a point that counts at all
constexpr int kBands = 32;

float squared(float x) { return x * x; }

// How far two surfaces may lie apart that are taken for the same skin, if that is as unsure.
float allowed_mm(float sigma_mm) { return std::clamp(kDisagreeSigmas * sigma_mm, kDisagreeMm, kReachMm); }

// The master where it sees well; else whoever is surest.
float rank(std::size_t k, float trust, float weight) {
  return k == 0 && trust >= kFullTrust ? std::numeric_limits<float>::max() : weight;
}

}  // namespace

PoseBlend::PoseBlend(std::span<const HeadPose> poses, const Registration& registration,
                     const HeadZones& zones, StageContext& context)
    : poses_(poses),
      registration_(registration),
      zones_(zones),
      context_(context),
      back_(&context.scratch),
      usual_(&context.scratch) {
  for (const RegisteredPose& p : registration.poses) back_.push_back(inverse(p.first_from_pose));
  usual_.reserve(poses.size());
  for (const HeadPose& pose : poses) {
    const Arena::Mark mark(context.scratch);
    std::pmr::vector<float> sigmas(&context.scratch);
    sigmas.reserve(pose.nodes.size());
    for (const SurfaceHit& node : pose.nodes)
      if (node.trust > 0) sigmas.push_back(node.sigma_mm);
    usual_.push_back(float(median(sigmas)));
  }
}

std::optional<SurfaceHit> PoseBlend::look(std::size_t k, const Vec3f& place) const {
  auto hit = poses_[k].look(narrow(apply(back_[k], wide(place))));
  if (!hit || hit->trust <= kLeastTrust) return std::nullopt;
  hit->trust = (hit->trust - kLeastTrust) / (1 - kLeastTrust) * (k == 0 ? 1 : zones_.others_share(place));
  const RigidTransform& placed = registration_.poses[k].first_from_pose;
  hit->at_mm = narrow(apply(placed, wide(hit->at_mm)));
  hit->normal = narrow(apply(placed.rotation, wide(hit->normal)));
  return hit;
}

bool PoseBlend::is_seen_near(const Vec3f& place) const {
  constexpr float kNearMm = 15;
  for (std::size_t k = 0; k < poses_.size(); ++k)
    if (const auto hit = look(k, place); hit && distance(hit->at_mm, place) < kNearMm) return true;
  return false;
}

std::pmr::vector<FieldPoint> PoseBlend::points(float voxel_mm) const {
  std::pmr::vector<FieldPoint> all(&context_.scratch);
  std::size_t room = 0;
  for (const HeadPose& p : poses_) room += p.nodes.size();
  all.reserve(room);
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    const HeadPose& pose = poses_[k];
    const RigidTransform& placed = registration_.poses[k].first_from_pose;
    const std::size_t first = all.size(), columns = std::size_t(pose.columns);
    const auto dense_mm = float(kDenseVoxels * pose.focal_px / pose.step_px) * voxel_mm;
    all.resize(first + pose.nodes.size());  // weight 0: does not count
    context_.pool.for_each<std::size_t>(int(pose.nodes.size()), kBands, [&](std::size_t i) {
      if (pose.nodes[i].trust < kLeastTrust) return;
      if (pose.nodes[i].at_mm.z < dense_mm && (i % columns + i / columns) % 2 != 0) return;
      const Vec3f at = narrow(apply(placed, wide(pose.nodes[i].at_mm)));
      if (!zones_.is_head(at) || zones_.is_eye(at)) return;
      const Vec3f normal = narrow(apply(placed.rotation, wide(pose.nodes[i].normal)));
      const float trust = pose.nodes[i].trust * (k == 0 ? 1 : zones_.others_share(at));
      if (!overruled(k, at, normal, pose.nodes[i].sigma_mm, trust))
        all[first + i] = {at, normal, trust / squared(std::max(pose.nodes[i].sigma_mm, kLeastSigmaMm))};
    });
    all.erase(std::remove_if(all.begin() + std::ptrdiff_t(first), all.end(),
                             [](const FieldPoint& p) { return p.weight <= 0; }),
              all.end());
  }
  return all;
}

std::optional<PoseBlend::Placed> PoseBlend::settle(Vec3f at, const Vec3f& normal) const {
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

std::optional<PoseBlend::Placed> PoseBlend::step(const Vec3f& at, const Vec3f& normal) const {
  std::array<Seen, kMostPoses> seen{};
  std::size_t best = poses_.size();
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    const auto hit = look(k, at);
    if (!hit || dot(hit->normal, normal) < kSameWay) continue;
    const float d = dot(hit->normal, minus(at, hit->at_mm));
    if (std::abs(d) > 2 * kReachMm) continue;
    const float certainty = 1 / squared(std::max(hit->sigma_mm, kLeastSigmaMm));
    const float shared = std::sqrt(std::max(1 / certainty - squared(usual_[k]), 0.0F));
    seen[k] = {d, hit->trust * certainty, certainty, hit->trust, shared, hit->normal};
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
PoseBlend::Placed PoseBlend::mean_of(std::array<Seen, kMostPoses>& seen, std::size_t best, const Vec3f& at,
                                     const Vec3f& normal) const {
  // A surface that fades out is no surer at its end than the others, else they would take its place at once.
  float least = seen[best].certainty;
  for (const Seen& s : seen)
    if (s.weight > 0) least = std::min(least, s.certainty);
  Vec3f pull{};
  // Where lips shine or a fold is smoothed, a place is less sure than skin usually is: that misleads all
  // poses alike, and their mean knows no better. The rest is noise.
  float weight = 0, variance = 0, shared = 0;
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
    variance += squared(s.weight) * (1 / s.certainty - squared(s.shared));
    shared += s.weight * s.shared;
    if (s.weight > seen[most].weight) most = k;
    if (s.weight > 0) poses |= 1U << k;
  }
  const Vec3f there = along(at, -1 / weight, pull);
  const float registered = float(registration_sigma(most, there, normal));
  return {there, std::sqrt((variance + squared(shared)) / squared(weight) + squared(registered)),
          std::uint8_t(most), std::uint8_t(poses)};
}

// Another pose that counts for more shows the skin elsewhere.
bool PoseBlend::overruled(std::size_t k, const Vec3f& at, const Vec3f& normal, float sigma,
                          float trust) const {
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
double PoseBlend::registration_sigma(std::size_t k, const Vec3f& at, const Vec3f& normal) const {
  if (k == 0) return 0;
  const Vec3d n = wide(normal), turn = cross(minus(wide(at), registration_.pivot_mm), n);
  const std::array<double, 6> j{turn.x, turn.y, turn.z, n.x, n.y, n.z};
  double variance = 0;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b)
      variance += j[a] * j[b] * registration_.poses[k].covariance[6 * a + b];
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace relievo::pipeline
