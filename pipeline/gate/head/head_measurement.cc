// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/head_measurement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/match/region/face_reach.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Heads are mostly upright: one leaning by so much must mirror itself better by a square millimetre.
constexpr double kUprightDeg = 7;
// Of a turned head's own plane a fifth of the images falls where nothing is known, of one that sends the face
// away most.
constexpr double kMostUnknown = 0.35, kPriceOfUnknown = 100;
constexpr double kAsymmetryLimitMm = 12;  // of a point and its mirror image
constexpr double kMostOffsetMm = 15;      // of a head's mirror plane from the tip of its nose

// The plane in which the points of a relief mirror themselves best, looked for near an upright one through
// the tip of the nose.
struct MirrorPlane {
  double yaw_deg = 0, roll_deg = 0, offset_mm = 0;  // as HeadMeasurement; along the normal, from the tip
  double rms_mm = 0;  // of the points against the relief behind their mirror images
  double price = 0;   // the same, more for a head that leans: of two planes the cheaper one is the head's
};

// To the picture's right.
Vec3d normal_of(const MirrorPlane& plane, const HeadAxes& axes) {
  const double yaw = plane.yaw_deg * kDegree, roll = plane.roll_deg * kDegree;
  const Vec3d turned = along(times(axes.right, std::cos(yaw)), std::sin(yaw), axes.away);
  return along(times(turned, std::cos(roll)), -std::sin(roll), axes.down);
}

struct Search {
  const Relief& relief;
  std::span<const Vec3d> points;
  const Vec3d& tip;
  const HeadAxes& axes;
  bool upright = true;  // whether leaning has a price

  // Mean squared distance, in depth, between the points' mirror images and the relief behind them. An image
  // that falls where nothing is known costs a third of the limit, and more where many do: else planes that
  // send the face away would look good. Given up, and `least` returned, as soon as it cannot be less than
  // that any more.
  double cost(const MirrorPlane& plane, std::size_t every, double least = 1e300) const {
    const Vec3d n = normal_of(plane, axes);
    const double lean = upright ? plane.roll_deg / kUprightDeg : 0;
    const double most = (least - lean * lean) * double((points.size() + every - 1) / every);
    double total = 0;
    int count = 0, unknown = 0;
    for (std::size_t i = 0; i < points.size(); i += every, ++count) {
      const Vec3d& p = points[i];
      const Vec3d image = along(p, -2 * (dot(minus(p, tip), n) - plane.offset_mm), n);
      const Vec2d at = relief.pixel(image);
      const int x = Relief::nearest(at.x), y = Relief::nearest(at.y);
      double off = kAsymmetryLimitMm / 3;
      if (!relief.inside(x, y) || !relief.known(x, y)) ++unknown;
      else off = std::min(kAsymmetryLimitMm, std::abs(image.z - double(relief.depth_mm[relief.index(x, y)])));
      total += off * off;
      if (total > most) return least;
    }
    const double away = std::max(0.0, double(unknown) / std::max(1, count) - kMostUnknown);
    return total / std::max(1, count) + lean * lean + kPriceOfUnknown * away;
  }
};

// Steps along each of the three, halved when none helps.
MirrorPlane refine(const Search& search, MirrorPlane best, std::array<double, 3> step) {
  double least = search.cost(best, 1);
  for (int round = 0; round < 24 && step[0] > 0.2; ++round) {
    bool better = false;
    for (int k = 0; k < 6; ++k) {
      MirrorPlane tried = best;
      const double by = (k % 2 == 0 ? 1 : -1) * step[std::size_t(k / 2)];
      (k / 2 == 0 ? tried.yaw_deg : k / 2 == 1 ? tried.roll_deg : tried.offset_mm) += by;
      if (std::abs(tried.offset_mm) > kMostOffsetMm) continue;
      const double cost = search.cost(tried, 1, least);
      if (cost >= least) continue;
      least = cost;
      best = tried;
      better = true;
    }
    if (!better)
      for (double& s : step) s /= 2;
  }
  return best;
}

// The best of three ranges of yaw: turned to the picture's left, straight, to its right. A cheek alone
// mirrors itself about its own middle as well as a whole face does: which of the three is the head's, the
// nose must tell.
std::array<MirrorPlane, 3> find_mirror_planes(const Relief& relief, std::span<const Vec3d> points,
                                              const Vec3d& tip, const HeadAxes& axes) {
  const Search search{relief, points, tip, axes};
  const std::size_t every = std::max<std::size_t>(1, points.size() / 150);
  std::array<MirrorPlane, 3> best;
  std::array<double, 3> least{1e300, 1e300, 1e300};
  for (double yaw = -45; yaw <= 45; yaw += 9) {
    const std::size_t range = yaw < -13 ? 0 : yaw > 13 ? 2 : 1;
    for (double roll = -36; roll <= 36; roll += 9)
      for (double offset = -12; offset <= 12; offset += 6) {
        const MirrorPlane tried{yaw, roll, offset, 0};
        const double cost = search.cost(tried, every, least[range]);
        if (cost >= least[range]) continue;
        least[range] = cost;
        best[range] = tried;
      }
  }
  const Search unbiased{relief, points, tip, axes, false};
  for (MirrorPlane& plane : best) {
    plane = refine(search, plane, {4, 5, 3});
    plane = refine(unbiased, plane, {1, 1.5, 0.75});
    plane.rms_mm = std::sqrt(unbiased.cost(plane, 1));
    plane.price = std::sqrt(search.cost(plane, 1));
  }
  return best;
}

constexpr double kReachMm = 78;  // of the tip of the nose: brows and chin, little hair
constexpr std::size_t kLeastHeadPoints = 60;
constexpr double kNoseReachMm = 27;    // left out where the slope of the face is measured
constexpr double kMeanSlopeDeg = 2.6;  // of the average head that looks straight (hal/sim, seeds 1 and 2)
constexpr double kSettledMm = 6;       // a tip found anew within that of the old one: the mirror plane holds
constexpr int kRounds = 3;             // of that
constexpr double kLeastNoseMm = 10;    // a nose stands out further
constexpr double kHalfWidthMm = 52, kShapeUpMm = 75, kShapeDownMm = 55;  // the face about the tip of its nose

std::pmr::vector<Vec3d> points_about(const Relief& relief, const Vec3d& tip, StageContext& context) {
  std::pmr::vector<Vec3d> points(&context.scratch);
  const Vec2d at = relief.pixel(tip);
  const int reach = int(kReachMm * relief.focal_px / tip.z) + 1;
  const int stride = std::max(1, reach / 14);
  points.reserve(std::size_t((2 * reach / stride + 1) * (2 * reach / stride + 1)));
  for (int y = int(at.y) - reach; y <= int(at.y) + reach; y += stride)
    for (int x = int(at.x) - reach; x <= int(at.x) + reach; x += stride) {
      if (!relief.inside(x, y) || !relief.known(x, y)) continue;
      const Vec3d p = relief.point(x, y), d = minus(p, tip);
      if (dot(d, d) < kReachMm * kReachMm && d.z > -12 && points.size() < points.capacity())
        points.push_back(p);
    }
  return points;
}

// How far the face lies behind its nose: behind = level + slope * down + bend * right^2, by least squares,
// three times: the later ones without what the one before calls strange.
struct FaceForm {
  double level = 0, slope = 0, bend = 0;
  bool known = false;
  double behind(double right, double down) const { return level + slope * down + bend * right * right; }
};

FaceForm fit_form(std::span<const Vec3d> points, const HeadMeasurement& head) {
  FaceForm form;
  for (int round = 0; round < 3; ++round) {
    ThreeTerms terms;
    for (const Vec3d& p : points) {
      const Vec3d d = minus(p, head.tip_mm);
      const double right = dot(d, head.right), down = dot(d, head.down), behind = dot(d, head.away);
      if (right * right + down * down < kNoseReachMm * kNoseReachMm) continue;
      if (form.known && std::abs(behind - form.behind(right, down)) > 15) continue;
      terms.add({1, down, right * right}, behind);
    }
    const auto k = terms.solve();
    if (!k) return {};
    form = {(*k)[0], (*k)[1], (*k)[2], true};
  }
  return form;
}

// How far the cheeks beside the nose lie behind its tip; both sides together, so that a turn hardly matters.
double nose_height(std::span<const Vec3d> points, const HeadMeasurement& head) {
  std::array<double, 2> sum{}, count{};
  for (const Vec3d& p : points) {
    const Vec3d d = minus(p, head.tip_mm);
    const double right = dot(d, head.right), down = dot(d, head.down);
    if (std::abs(right) < 22 || std::abs(right) > 46 || down < -14 || down > 22) continue;
    sum[right > 0 ? 1 : 0] += dot(d, head.away);
    count[right > 0 ? 1 : 0] += 1;
  }
  if (count[0] < 3 && count[1] < 3) return 0;
  if (count[0] < 3 || count[1] < 3)
    return (sum[0] + sum[1]) / (count[0] + count[1]);  // the far cheek is out of sight
  return (sum[0] / count[0] + sum[1] / count[1]) / 2;
}

// What of the face is hidden: by something before it, or from one of the cameras.
void measure_cover(const Relief& relief, const FaceForm& form, HeadMeasurement& head) {
  const double pixel_mm = head.tip_mm.z / relief.focal_px, step = std::max(1.5, pixel_mm);
  int all = 0, before = 0, unknown = 0;
  for (double down = -kShapeUpMm; down <= kShapeDownMm; down += step)
    for (double right = -kHalfWidthMm; right <= kHalfWidthMm; right += step) {
      const double v = down < 0 ? down / kShapeUpMm : down / kShapeDownMm, u = right / kHalfWidthMm;
      if (u * u + v * v > 1) continue;
      const Vec3d level = along(along(head.tip_mm, right, head.right), down, head.down);
      const Vec3d guess = along(level, std::max(0.0, form.behind(right, down)), head.away);
      const Vec2d at = relief.pixel(guess);
      const int x = Relief::nearest(at.x), y = Relief::nearest(at.y);
      ++all;
      if (!relief.inside(x, y) || !relief.known(x, y)) {
        ++unknown;
        continue;
      }
      const double behind = dot(minus(relief.point(x, y), head.tip_mm), head.away);
      const bool nose = std::abs(right) < 25 && down > -50 && down < 15;
      if (behind < (nose ? -12 : form.behind(right, down) - 16)) ++before;
    }
  head.in_front_share = double(before) / std::max(1, all);
  head.unknown_share = double(unknown) / std::max(1, all);
}

// Axes of a head whose mirror plane this is, upright but for its roll.
void take_axes(const MirrorPlane& plane, const HeadAxes& axes, HeadMeasurement& head) {
  head.right = normal_of(plane, axes);
  head.down = unit(along(axes.down, -dot(axes.down, head.right), head.right));
  head.away = cross(head.right, head.down);
}

// What follows from the tip and the axes. False where no face can be fitted.
bool fit_face(std::span<const Vec3d> points, HeadMeasurement& head, FaceForm& form) {
  form = fit_form(points, head);
  head.pitch_deg = std::atan(form.slope) / kDegree - kMeanSlopeDeg;
  head.relief_mm = nose_height(points, head);
  return form.known;
}

// Everything that follows from where the tip is. False where no face can be fitted.
bool measure_about(const Relief& relief, StageContext& context, HeadMeasurement& head, FaceForm& form) {
  const std::pmr::vector<Vec3d> points = points_about(relief, head.tip_mm, context);
  if (points.size() < kLeastHeadPoints) return false;
  const HeadAxes axes = axes_facing_the_rig(head.tip_mm, relief.baseline_mm);
  HeadMeasurement best;
  double least = 0;
  for (const MirrorPlane& plane : find_mirror_planes(relief, points, head.tip_mm, axes)) {
    HeadMeasurement tried = head;
    take_axes(plane, axes, tried);
    tried.yaw_deg = plane.yaw_deg;
    tried.roll_deg = plane.roll_deg;
    tried.asymmetry_mm = plane.rms_mm;
    tried.relief_mm = nose_height(points, tried);
    tried.known = true;
    const bool has_nose = tried.relief_mm > kLeastNoseMm, best_has = best.relief_mm > kLeastNoseMm;
    if (!best.known || (has_nose != best_has ? has_nose : plane.price < least))
      best = tried, least = plane.price;
  }
  head = best;
  return fit_face(points, head, form);
}

// The tip out of the profile: where it has hardly moved, the mirror plane holds, else that is looked for
// again about the new one.
void settle_tip(const Relief& relief, const HeadHint& hint, StageContext& context, HeadMeasurement& head,
                FaceForm& form) {
  for (int round = 0; round < kRounds; ++round) {
    HeadMeasurement again = head;
    FaceForm form_again;
    if (!tip_of_profile(relief, hint, head, context, again.tip_mm)) return;
    const bool settled = length(minus(again.tip_mm, head.tip_mm)) < kSettledMm;
    if (!(settled ? fit_face(points_about(relief, again.tip_mm, context), again, form_again)
                  : measure_about(relief, context, again, form_again)))
      return;
    head = again;
    form = form_again;
    if (settled) return;
  }
}

}  // namespace

HeadAxes axes_facing_the_rig(const Vec3d& at, double baseline_mm) {
  HeadAxes axes;
  axes.away = unit(Vec3d{at.x - baseline_mm / 2, at.y, at.z});
  axes.right = unit(along({1, 0, 0}, -axes.away.x, axes.away));
  axes.down = cross(axes.away, axes.right);
  return axes;
}

HeadMeasurement measure_head(const Relief& relief, const HeadHint& hint, StageContext& context) {
  HeadMeasurement head;
  if (!(hint.width_px > 0) || !std::isfinite(hint.centre_px.x + hint.centre_px.y + hint.width_px))
    return head;
  Arena::Mark mark(context.scratch);
  if (!rough_tip(relief, hint, context, head.tip_mm)) return head;
  FaceForm form;
  if (!measure_about(relief, context, head, form)) return {};
  settle_tip(relief, hint, context, head, form);
  measure_cover(relief, form, head);
  return head;
}

FacePlace place_on(const Relief& relief, const HeadMeasurement& head, double right_mm, double down_mm) {
  Vec3d p = along(along(head.tip_mm, right_mm, head.right), down_mm, head.down);
  FacePlace place;
  for (int round = 0; round < 3; ++round) {  // along the line of sight onto the surface
    const Vec2d at = relief.pixel(p);
    place.x = Relief::nearest(at.x), place.y = Relief::nearest(at.y);
    place.inside = relief.inside(place.x, place.y);
    if (!place.inside || !relief.known(place.x, place.y)) return place;
    const double behind = dot(minus(relief.point(place.x, place.y), p), head.away);
    p = along(p, behind, head.away);
  }
  return place;
}

}  // namespace relievo::pipeline
