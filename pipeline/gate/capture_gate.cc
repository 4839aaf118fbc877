// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/capture_gate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/gate/head/head_outline.h"
#include "pipeline/gate/light/face_light.h"

namespace relievo::pipeline {
namespace {

constexpr GateLimits kLimits;
constexpr double kFaceWidthMm = 150;      // what a cascade's box stands for
constexpr double kSecondFaceShare = 0.4;  // smaller ones are passers-by far away
constexpr int kSecondFaceVotes = 8;
constexpr double kTurnSmoothing = 0.5;
constexpr GateTime kKeepsTrack = std::chrono::milliseconds{1500};  // of a head that no cascade sees any more
// What is measured wanders by a millimetre: over less time that would look like haste, however fast the
// pictures come.
constexpr GateTime kShortestMotion = std::chrono::milliseconds{50};
constexpr double kNeckMm = 60;  // a head turns about an axis so far behind the tip of its nose, or farther

// A second face must be as wide as one at its own distance, where that is known.
bool is_face(const Relief& relief, const FaceBox& hit) {
  const int x = int(std::lround(hit.centre_px.x)), y = int(std::lround(hit.centre_px.y));
  if (!relief.inside(x, y) || !relief.known(x, y)) return hit.votes >= 2 * kSecondFaceVotes;
  const double width_mm = hit.width_px * double(relief.depth_mm[relief.index(x, y)]) / relief.focal_px;
  return hit.votes >= kSecondFaceVotes && width_mm > 90 && width_mm < 240;
}

void measure_picture(const Relief& relief, double nearest_mm, GateMeasures& m) {
  std::size_t dark = 0, bright = 0, near = 0;
  for (const std::uint8_t v : relief.grey) dark += v <= 25 ? 1U : 0U;
  const int x0 = relief.width_px / 3, x1 = 2 * relief.width_px / 3, y0 = relief.height_px / 5,
            y1 = 4 * relief.height_px / 5;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const std::size_t i = relief.index(x, y);
      bright += relief.grey[i] >= 247 ? 1U : 0U;
      near += relief.known(x, y) && double(relief.depth_mm[i]) < nearest_mm ? 1U : 0U;
    }
  const auto middle = double(std::max(1, (x1 - x0) * (y1 - y0)));
  m.picture_dark_share = double(dark) / double(std::max<std::size_t>(1, relief.grey.size()));
  m.middle_bright_share = double(bright) / middle;
  m.middle_near_share = double(near) / middle;
}

// What may be said of a head that no cascade has seen; what it looks like may be a collar's doing.
bool is_of_place_or_pose(Advice advice) { return advice >= Advice::TooClose && advice <= Advice::Tilted; }

double apart(const Vec2d& a, const Vec2d& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// The tip of a nose that is hardly seen wanders over the face, and so does the cascade's box, but not
// together: across the picture the lesser of both counts, in depth the tip.
double moved_mm(const Relief& relief, const SeenHead& from, const SeenHead& to) {
  const Vec3d &a = from.tip_mm, &b = to.tip_mm;
  double across = apart({a.x, a.y}, {b.x, b.y});
  if (to.by_cascade && from.by_cascade)
    across = std::min(across, apart(from.face.centre_px, to.face.centre_px) * b.z / relief.focal_px);
  return std::hypot(across, b.z - a.z);
}

void measure_motion(const Relief& relief, const SeenHead& now, const GateHistory& history, GateMeasures& m) {
  m.speed_mm_s = history.speed_mm_s;
  m.turn_deg_s = history.turn_deg_s;
  if (now.at - history.from.at < kShortestMotion) return;
  const double seconds = std::chrono::duration<double>(now.at - history.from.at).count();
  const double moved = moved_mm(relief, history.from, now), speed = moved / seconds;
  // The tip of a nose at rest wanders by a millimetre from picture to picture: two pictures speak together.
  m.speed_mm_s = kTurnSmoothing * speed + (1 - kTurnSmoothing) * std::min(history.speed_mm_s, 2 * speed);
  // Where the tip stays, it is not the head that turns but the mirror plane of a poor relief.
  const double turn =
      std::min(std::abs(now.yaw_deg - history.from.yaw_deg), moved / kNeckMm * 180 / std::numbers::pi) /
      seconds;
  m.turn_deg_s = kTurnSmoothing * turn + (1 - kTurnSmoothing) * std::min(history.turn_deg_s, 2 * turn);
}

void remember(const SeenHead& now, const GateMeasures& m, GateHistory& history) {
  const bool before = std::exchange(history.seen, m.head.known);
  if (!m.head.known) return;
  if (!before || now.at - history.from.at >= kShortestMotion) history.from = now;
  if (now.by_cascade) history.last_by_cascade = now.at;
  history.last = now;
  history.speed_mm_s = m.speed_mm_s;
  history.turn_deg_s = m.turn_deg_s;
}

// What is said changes when two pictures in a row say otherwise; that all is well, only when both say so.
void settle(GateTime now, GateAnswer& answer, GateHistory& history) {
  const bool otherwise =
      answer.reason != history.said && history.heard != history.said && answer.reason != Advice::None;
  if (answer.reason == history.heard || otherwise) history.said = answer.reason;
  const bool good = answer.reason == Advice::None;
  if (good && history.heard != Advice::None) history.good_since = now;
  history.heard = answer.reason;
  answer.advice = history.said;
  answer.steady = good ? now - history.good_since : GateTime{0};
}

}  // namespace

Result<CaptureGate> CaptureGate::open(const LiveRelief& relief, const std::string& cascade_folder) {
  RELIEVO_TRY(relief.check());
  RELIEVO_TRY_ASSIGN(FaceWatch watch, FaceWatch::open(cascade_folder));
  return CaptureGate(relief, std::move(watch));
}

Result<GateLook> CaptureGate::look(const StereoFrame& frame, const StereoCalibration& calibration,
                                   GateTime now, GateHistory& history, StageContext& context) {
  RELIEVO_TRY_ASSIGN(Relief relief, relief_.look(frame, calibration, context));
  RELIEVO_TRY_ASSIGN(const FaceHits hits, watch_.look(relief));
  GateAnswer answer;
  GateMeasures& m = answer.measures;
  measure_picture(relief, kLimits.nearest_mm, m);
  m.faces = std::min(hits.count, 1);
  for (int i = 1; i < hits.count; ++i) {
    const FaceBox& hit = hits.hit[std::size_t(i)];
    if (hit.width_px > kSecondFaceShare * hits.hit[0].width_px && is_face(relief, hit)) ++m.faces;
  }
  if (hits.count > 0) {
    m.face = {hits.hit[0].centre_px, hits.hit[0].width_px};
    m.guessed_mm = kFaceWidthMm * relief.focal_px / m.face.width_px;
    m.head = measure_head(relief, m.face, context);
  }
  const auto look_at = [&](const HeadHint& place) {
    const HeadMeasurement head = measure_head(relief, place, context);
    m.tracked = head.known && head.relief_mm > kLimits.relief_mm;
    if (m.tracked) m.face = place, m.head = head, m.faces = std::max(m.faces, 1);
  };
  if (!m.head.known && history.seen && now - history.last_by_cascade < kKeepsTrack) {
    // Where the head was a moment ago, as a face to look for.
    const Vec3d& tip = history.last.tip_mm;
    const Vec2d at = relief.pixel(tip);
    const double width = kFaceWidthMm * relief.focal_px / tip.z;
    look_at({{at.x, at.y - 0.08 * width}, width});
  }
  const bool unseen = !m.head.known && m.faces == 0;
  if (unseen) {
    const Somebody somebody = find_somebody(relief, kLimits.farthest_mm);
    m.somebody_right = somebody.right, m.somebody_down = somebody.down;
    look_at(somebody.head);
  }
  // To which side a head is turned far the outline tells: a cheek taken for a face mirrors itself, too, in a
  // plane that looks the other way, but lies on the right side of its outline. The yaw itself it tells of a
  // head that does not mirror itself. Something before a face takes the mirror image away, too, but leaves
  // the nose before the middle.
  const bool doubtful = m.head.known && m.head.asymmetry_mm >= kLimits.doubtful_mm;
  if (doubtful || !(std::abs(m.head.yaw_deg) <= kLimits.yaw_deg)) {
    const double yaw = outline_yaw_deg(relief, m.head.tip_mm);
    m.turned_far = doubtful && std::abs(yaw) > kLimits.yaw_deg;
    m.head.yaw_deg = m.turned_far ? yaw : std::copysign(m.head.yaw_deg, yaw);
  }
  if (m.face.width_px > 0) m.covered_share = covered_share(relief, m.face);
  const SeenHead seen{now, m.head.known && !m.tracked, m.head.tip_mm, m.head.yaw_deg, m.face};
  if (m.head.known) {
    m.off_right_mm = m.head.tip_mm.x - relief.baseline_mm / 2;
    m.off_down_mm = m.head.tip_mm.y;
    m.light = measure_light(relief, m.head);
    // In the dark and in glare the head seems to tremble: nothing is said of its motion there.
    const bool lit =
        m.light.luminance_mean >= kLimits.darkest_mean && m.light.luminance_mean <= kLimits.brightest_mean;
    if (lit && history.seen) measure_motion(relief, seen, history, m);
    m.blur_mm = measure_blur_mm(frame, calibration, relief, m.head, context);
    m.beside_share = beside_share(relief, m.head);
    const FacePhoto photo{frame, calibration, relief, m.head};
    m.eyes = measure_eyes(photo, context);
    m.mouth = measure_mouth(photo, context);
  }
  answer.reason = judge(m, history.said);
  if (unseen && m.tracked && !is_of_place_or_pose(answer.reason)) {
    m.head = {}, m.face = {}, m.tracked = false, m.faces = 0;
    answer.reason = judge(m, history.said);
  }
  remember(seen, m, history);
  settle(now, answer, history);
  return GateLook{answer, std::move(relief)};
}

}  // namespace relievo::pipeline
