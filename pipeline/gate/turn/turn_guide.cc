// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/turn/turn_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kReachMm = 105, kBelowMm = 50;  // of the tip of the nose: the neck turns otherwise
constexpr double kBehindMm = 85;                 // what is further behind it is hair or a collar
constexpr double kPivotMm = 105;                 // behind the tip
constexpr int kSlopePx = 3;                      // normals are those of the relief so far about a place
constexpr double kSlopeStepMm = 25;              // more than that between neighbours is an edge
constexpr double kSeenCosine = 0.35;             // a surface that is more inclined is hardly matched
constexpr std::size_t kFewest = 80;
constexpr double kMetMm = 4,
                 kMetShare = 0.78;  // of a head that was found: elsewhere three quarters may seem to fit ...
constexpr double kSureShare = 0.9;  // ... and where fewer do, other places are tried, too
constexpr double kSettled = 0.02;   // mm and mrad of the last step
// How far from the live surface a point may lie, and the scale beyond which its distance loses its say.
struct Round {
  double reach_mm, scale_mm;
  int times;
};
constexpr std::array<Round, 3> kRounds{{{40, 15, 10}, {15, 6, 10}, {8, 3, 15}}};
constexpr std::array<double, 9> kStartsDeg{0, -15, 15, -28, 28, -40, 40, -52, 52};

std::optional<Vec3d> normal_at(const Relief& relief, int x, int y) {
  const auto known = [&](int u, int v) { return relief.inside(u, v) && relief.known(u, v); };
  if (!known(x - kSlopePx, y) || !known(x + kSlopePx, y) || !known(x, y - kSlopePx) ||
      !known(x, y + kSlopePx))
    return std::nullopt;
  const Vec3d across = minus(relief.point(x + kSlopePx, y), relief.point(x - kSlopePx, y));
  const Vec3d along_y = minus(relief.point(x, y + kSlopePx), relief.point(x, y - kSlopePx));
  if (std::abs(across.z) > kSlopeStepMm || std::abs(along_y.z) > kSlopeStepMm) return std::nullopt;
  return unit(cross(along_y, across));  // towards the camera
}

struct Laid {
  std::size_t seen = 0, met = 0, used = 0;  // seen: where the relief is known
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
};

// Each point of the face where `motion` puts it, against what the relief shows in that direction.
Laid lay(const FrontFace& front, const Relief& relief, const RigidTransform& motion, const Round& round) {
  Laid laid;
  const Vec3d pivot = apply(motion, front.pivot_mm);
  for (std::size_t i = 0; i < front.count; ++i) {
    const Vec3d at = apply(motion, front.points[i].at_mm), n = apply(motion.rotation, front.points[i].normal);
    if (-dot(n, unit(at)) < kSeenCosine) continue;
    const Vec2d px = relief.pixel(at);
    const int x = Relief::nearest(px.x), y = Relief::nearest(px.y);
    if (!relief.inside(x, y) || !relief.known(x, y)) continue;
    ++laid.seen;
    const double off = dot(n, minus(relief.point(x, y), at));
    if (std::abs(off) < kMetMm) ++laid.met;
    if (std::abs(off) > round.reach_mm) continue;
    const double s = round.scale_mm * round.scale_mm, w = s / (s + off * off);
    const Vec3d lever = cross(minus(at, pivot), n);
    Vector6 toward;
    toward << lever.x, lever.y, lever.z, n.x, n.y, n.z;
    laid.normal += w * w * toward * toward.transpose();
    laid.right += w * w * off * toward;
    ++laid.used;
  }
  return laid;
}

HeadTurn settle(const FrontFace& front, const Relief& relief, RigidTransform motion) {
  for (const Round& round : kRounds)
    for (int k = 0; k < round.times; ++k) {
      Laid laid = lay(front, relief, motion, round);
      if (laid.used < kFewest) return {};
      laid.normal += 1e-6 * laid.normal.trace() * Matrix6::Identity();
      const Vector6 step = laid.normal.ldlt().solve(laid.right);
      motion = product(small_motion({step[0], step[1], step[2]}, {step[3], step[4], step[5]},
                                    apply(motion, front.pivot_mm)),
                       motion);
      if (1000 * step.head<3>().norm() < kSettled && step.tail<3>().norm() < kSettled) break;
    }
  const Laid last = lay(front, relief, motion, kRounds.back());
  HeadTurn turn;
  turn.now_from_front = motion;
  turn.met_share = double(last.met) / double(std::max<std::size_t>(1, last.seen));
  turn.known = last.met >= kFewest && turn.met_share >= kMetShare;
  const auto in_head = [&](const Vec3d& axis) {
    const Vec3d now = apply(motion.rotation, axis);
    return Vec3d{dot(now, front.right), dot(now, front.down), dot(now, front.away)};
  };
  const Vec3d faces = in_head(times(front.away, -1)), side = in_head(front.right);
  constexpr double kDegrees = 180 / std::numbers::pi;
  turn.yaw_deg = std::atan2(faces.x, -faces.z) * kDegrees;
  turn.pitch_deg = std::atan2(faces.y, std::hypot(faces.x, faces.z)) * kDegrees;
  turn.roll_deg = std::atan2(side.y, std::hypot(side.x, side.z)) * kDegrees;
  return turn;
}

constexpr double kSideReachDeg = 8;  // so far from its angle a side is still taken
constexpr double kLevelDeg = 12;     // of pitch and roll against the front
constexpr int kSlowPictures = 2;
// A tracked head at rest wanders by tenths of a millimetre from picture to picture: of two that follow at
// once nothing can be told.
constexpr double kShortestS = 0.04, kWanderMm = 0.35;
constexpr double kHeardAfterS = 0.6,
                 kCalmDegS = 12;  // until a person does what they were told; slow enough to stop
constexpr double kClearlyDeg = 6;

// Who comes no nearer to a side for so long cannot or will not turn there: the other hand is asked for.
constexpr double kGivenUpAfterS = 6, kNearerDeg = 3;

// The one that is least far to turn to. The one that was asked for stays until another is clearly nearer:
// between two as far the advice would change with every picture.
std::size_t next_side(double yaw_deg, TurnHistory& history) {
  if ((history.taken | history.given_up).all()) history.given_up.reset();
  const auto far = [&](std::size_t i) { return std::abs(kSidesDeg[i] - yaw_deg); };
  const auto out = history.taken | history.given_up;
  std::size_t nearest = kSides;
  for (std::size_t i = 0; i < kSides; ++i)
    if (!out[i] && (nearest == kSides || far(i) < far(nearest))) nearest = i;
  const std::size_t asked = history.asked.value_or(nearest);
  return out[asked] || far(nearest) + kClearlyDeg < far(asked) ? nearest : asked;
}

void ask(double yaw_deg, std::chrono::nanoseconds at, TurnHistory& history) {
  const auto before = history.asked;
  history.asked = next_side(yaw_deg, history);
  const double side = kSidesDeg[*history.asked], off = std::abs(side - yaw_deg);
  if (history.asked != before || off <= kSideReachDeg || off < history.nearest_deg - kNearerDeg) {
    history.nearest_deg = off, history.nearer_at = at;
  } else if (std::chrono::duration<double>(at - history.nearer_at).count() > kGivenUpAfterS) {
    for (std::size_t i = 0; i < kSides; ++i)
      if (kSidesDeg[i] * side > 0) history.given_up.set(i);
  }
}

}  // namespace

void front_face(const Relief& relief, const HeadMeasurement& head, FrontFace& face) {
  face.count = 0;
  if (!head.known) return;
  face.right = head.right, face.down = head.down, face.away = head.away;
  face.pivot_mm = along(head.tip_mm, kPivotMm, head.away);
  const Vec2d at = relief.pixel(head.tip_mm);
  const int reach = int(kReachMm * relief.focal_px / head.tip_mm.z) + 1;
  constexpr int kAcross = 48;  // of a disc that is cut below and behind at most kMost remain
  const int stride = std::max(1, (2 * reach + kAcross - 1) / kAcross);
  for (int y = int(at.y) - reach; y <= int(at.y) + reach; y += stride)
    for (int x = int(at.x) - reach; x <= int(at.x) + reach; x += stride) {
      if (face.count == FrontFace::kMost) return;
      if (!relief.inside(x, y) || !relief.known(x, y)) continue;
      const Vec3d p = relief.point(x, y), d = minus(p, head.tip_mm);
      const double below = dot(d, head.down), behind = dot(d, head.away);
      if (dot(d, d) > kReachMm * kReachMm || below > kBelowMm || behind > kBehindMm || behind < -15) continue;
      if (const auto normal = normal_at(relief, x, y)) face.points[face.count++] = {p, *normal};
    }
}

HeadTurn follow_head(const FrontFace& front, const Relief& relief, const HeadTurn& before) {
  if (front.count < kFewest) return {};
  HeadTurn best;
  if (before.known) best = settle(front, relief, before.now_from_front);
  if (best.known && best.met_share >= kSureShare) return best;
  for (const double yaw : kStartsDeg) {
    const double angle = -yaw * std::numbers::pi / 180;  // about `down` a positive angle turns to the left
    const RigidTransform start = small_motion(times(front.down, angle), {}, front.pivot_mm);
    const HeadTurn turn = settle(front, relief, start);
    if (turn.known && (!best.known || turn.met_share > best.met_share)) best = turn;
  }
  return best;
}

double moved_mm(const FrontFace& front, const HeadTurn& from, const HeadTurn& to) {
  double most = 0;
  for (std::size_t i = 0; i < front.count; ++i) {
    const Vec3d& p = front.points[i].at_mm;
    most = std::max(most, distance(apply(from.now_from_front, p), apply(to.now_from_front, p)));
  }
  return most;
}

TurnAnswer guide_turn(const FrontFace& front, const HeadTurn& now, std::chrono::nanoseconds at,
                      double slow_mm_s, TurnHistory& history) {
  const auto say = [&](TurnAdvice advice, std::optional<std::size_t> take = {}) {
    history.advice = advice;
    return TurnAnswer{advice, take};
  };
  if (history.taken.all()) return say(TurnAdvice::Done);
  const HeadTurn before = history.last;
  const double seconds = std::chrono::duration<double>(at - history.last_at).count();
  if (!now.known || !before.known || seconds >= kShortestS) history.last = now, history.last_at = at;
  if (!now.known) {
    history.slow = 0;
    return say(TurnAdvice::Lost);
  }
  ask(now.yaw_deg, at, history);
  const double off = kSidesDeg[*history.asked] - now.yaw_deg;
  const bool there = std::abs(off) <= kSideReachDeg;
  const bool level = std::abs(now.pitch_deg) <= kLevelDeg && std::abs(now.roll_deg) <= kLevelDeg;
  if (before.known && seconds < kShortestS) return say(history.advice);
  const bool slow = before.known && moved_mm(front, before, now) - kWanderMm <= slow_mm_s * seconds;
  history.slow = there && level && slow ? history.slow + 1 : 0;
  if (!level) return say(TurnAdvice::Level);
  if (!there) {
    // Who is told only when they are there is past it before they have heard.
    const double coming_deg_s =
        before.known ? (now.yaw_deg - before.yaw_deg) / seconds * (off > 0 ? 1 : -1) : 0;
    const bool past_soon =
        coming_deg_s * kHeardAfterS > std::abs(off) - kSideReachDeg && coming_deg_s > kCalmDegS;
    return say(past_soon ? TurnAdvice::Slower : off > 0 ? TurnAdvice::ToRight : TurnAdvice::ToLeft);
  }
  if (history.slow >= kSlowPictures) return say(TurnAdvice::Hold, history.asked);
  return say(slow || !before.known ? TurnAdvice::Hold : TurnAdvice::Slower);
}

}  // namespace relievo::pipeline
