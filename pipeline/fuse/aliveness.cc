// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/aliveness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "pipeline/fuse/pose_registration.h"
#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kBallMm = 12.1;     // radius (Bekerman, Gottlieb, Vaiman 2014)
constexpr double kBehindLidsMm = 4;  // its middle, behind the middle of the corners of the lids
constexpr int kAcross = 72,
              kUp = 8;  // degrees of the ball that are looked at, to each side: between the lids
constexpr int kStep = 2;
constexpr int kColumns = 2 * kAcross / kStep + 1, kRows = 2 * kUp / kStep + 1;
constexpr int kPatternDeg = 36;                          // to each side of the pupil: iris and white
constexpr int kIrisDeg = 22, kWhiteDeg = 32;             // from the pupil: surely the one, surely the other
constexpr double kLeastFacing = 0.35;                    // cosine: what of the ball a camera sees well
constexpr double kLeastTurnDeg = 15, kMostTurnDeg = 40;  // beyond, too little of the ball is seen
// Where eyes that turned with the head show the pattern, and where eyes on the cameras do, which may lag
// behind: no further than so many degrees, from so many on.
constexpr int kStaysDeg = 6, kFollowsDeg = 14;

constexpr double kLeastFollowing = 0.1, kLeastContrast = 0.1;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }
double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Lightness on an eye's ball; negative where the camera does not see it well.
class BallPicture {
 public:
  // `middle`: of the ball, head frame.
  BallPicture(const HeadView& view, const RigidTransform& view_from_face, const Vec3d& middle) {
    const PhotoSampler photo(view.rgb, view.width_px, view.height_px);
    const Vec3d eye = apply(inverse(view_from_face), Vec3d{});
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c) {
        const double a = radians(across_deg(c)), u = radians(up_deg(r));
        const Vec3d out{std::sin(a) * std::cos(u), std::sin(u), std::cos(a) * std::cos(u)};
        const Vec3d at = plus(middle, times(out, kBallMm));
        const Vec3d to_eye = minus(eye, at);
        float& light = light_[index(c, r)];
        light = -1;
        if (dot(out, to_eye) < kLeastFacing * length(to_eye)) continue;
        const Vec3d seen = apply(view_from_face, at);
        const double x = view.centre_px.x + view.focal_px * seen.x / seen.z;
        const double y = view.centre_px.y + view.focal_px * seen.y / seen.z;
        if (!(x >= 0 && y >= 0 && x < view.width_px - 1 && y < view.height_px - 1)) continue;
        float rgb[3];
        photo.read(float(x), float(y), rgb);
        light = (rgb[0] + rgb[1] + rgb[2]) / 3;
      }
  }

  // How alike what lies about `pupil_deg` in the picture before is to what lies `shift_deg` beside it here:
  // correlation; 0 where too little is seen in both.
  double alike(const BallPicture& before, double pupil_deg, int shift_deg) const {
    const int pupil = int(std::lround((pupil_deg + kAcross) / kStep)), shift = shift_deg / kStep;
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    int all = 0;
    for (int r = 0; r < kRows; ++r)
      for (int c = pupil - kPatternDeg / kStep; c <= pupil + kPatternDeg / kStep; ++c) {
        ++all;
        if (c < 0 || c >= kColumns || c + shift < 0 || c + shift >= kColumns) continue;
        const double x = double(before.light_[index(c, r)]);
        const double y = double(light_[index(c + shift, r)]);
        if (x < 0 || y < 0) continue;
        n += 1;
        a += x;
        b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
      }
    if (2 * n < all) return 0;
    const double spread = (aa - a * a / n) * (bb - b * b / n);
    return spread > 0 ? (ab - a * b / n) / std::sqrt(spread) : 0;
  }
  // How much darker the iris is than what lies beside it, share.
  double contrast(double pupil_deg) const {
    struct Mean {
      double sum = 0, count = 0;
    } iris, white;
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c) {
        const double off = std::abs(across_deg(c) - pupil_deg);
        const auto light = double(light_[index(c, r)]);
        if (light < 0 || (off > kIrisDeg && off < kWhiteDeg) || off > kWhiteDeg + kIrisDeg) continue;
        Mean& its = off <= kIrisDeg ? iris : white;
        its.sum += light;
        its.count += 1;
      }
    if (iris.count == 0 || white.count == 0 || white.sum == 0) return 0;
    return 1 - iris.sum / iris.count / (white.sum / white.count);
  }

 private:
  static double across_deg(int column) { return kStep * column - kAcross; }
  static double up_deg(int row) { return kStep * row - kUp; }
  static std::size_t index(int column, int row) { return std::size_t(row) * kColumns + std::size_t(column); }

  std::array<float, std::size_t(kColumns) * kRows> light_;
};

// An eye of the master's face, in the head frame, and how it looks from the cameras.
struct Eye {
  Vec3d middle;
  std::array<BallPicture, 2> first;
  double first_deg;  // where the cameras stood, seen from the ball
};

double camera_deg(const RigidTransform& view_from_face, const Vec3d& middle) {
  const Vec3d to = minus(apply(inverse(view_from_face), Vec3d{}), middle);
  return degrees(std::atan2(to.x, to.z));
}

// What the pictures of one pose say, of both eyes from both cameras.
class PoseVotes {
 public:
  void add(const Eye& eye, std::size_t side, const HeadView& view, const RigidTransform& view_from_face) {
    const BallPicture picture(view, view_from_face, eye.middle);
    turned_deg_ += camera_deg(view_from_face, eye.middle) - eye.first_deg;
    ++count_;
    for (std::size_t s = 0; s < sum_.size(); ++s) {
      const double alike = picture.alike(eye.first.at(side), eye.first_deg, shift_deg(s));
      if (alike == 0) continue;
      sum_.at(s) += alike;
      ++seen_.at(s);
    }
  }
  // None: the head hardly turned, or too far.
  std::optional<double> following() const {
    const double turned = count_ > 0 ? turned_deg_ / count_ : 0;
    if (std::abs(turned) < kLeastTurnDeg || std::abs(turned) > kMostTurnDeg) return std::nullopt;
    double stays = -1, follows = -1;
    for (std::size_t s = 0; s < sum_.size(); ++s) {
      if (seen_.at(s) == 0) continue;
      const double alike = sum_.at(s) / seen_.at(s);
      const double along = turned > 0 ? shift_deg(s) : -shift_deg(s);
      if (std::abs(along) <= kStaysDeg) stays = std::max(stays, alike);
      if (along >= kFollowsDeg && along <= std::abs(turned) + kStaysDeg) follows = std::max(follows, alike);
    }
    return follows - stays;
  }

 private:
  static constexpr int kMostShiftDeg = int(kMostTurnDeg) + kStaysDeg;
  static int shift_deg(std::size_t s) { return kStep * int(s) - kMostShiftDeg; }

  double turned_deg_ = 0;
  int count_ = 0;
  std::array<double, kMostShiftDeg + 1> sum_{};
  std::array<int, kMostShiftDeg + 1> seen_{};
};
static_assert(kStep == 2);  // as many shifts as degrees to one side, and the middle

}  // namespace

Aliveness::Verdict Aliveness::verdict() const {
  if (!eyes_follow || !iris_contrast) return Verdict::Unjudged;
  return *eyes_follow >= kLeastFollowing && *iris_contrast >= kLeastContrast ? Verdict::Alive
                                                                             : Verdict::NotAlive;
}

Error error_of(const Aliveness& aliveness) {
  std::array<char, 100> figures{};
  std::snprintf(figures.data(), figures.size(),
                "eyes_follow %.2f (%.2f asked), iris_contrast %.2f (%.2f asked)",
                aliveness.eyes_follow.value_or(0), kLeastFollowing, aliveness.iris_contrast.value_or(0),
                kLeastContrast);
  return Error{Errc::NoFace,
               "the eyes are closed or turned with the head, as painted ones do: look at the screen while "
               "the head turns"}
      .at(figures.data());
}

Aliveness measure_aliveness(std::span<const HeadView> views, const Landmarks& landmarks,
                            const RigidTransform& head_from_camera) {
  using enum LandmarkName;
  constexpr std::array<std::array<LandmarkName, 2>, 2> kCorners{
      {{EndocanthionLeft, ExocanthionLeft}, {EndocanthionRight, ExocanthionRight}}};
  const auto from_face = [&](const HeadView& view) {
    return product(view.view_from_head, inverse(head_from_camera));
  };
  Aliveness seen;
  std::array<PoseVotes, kMostPoses> votes{};
  for (const auto& [inner, outer] : kCorners) {
    if (!of(landmarks, inner).found || !of(landmarks, outer).found) continue;
    const Vec3d a = apply(head_from_camera, wide(of(landmarks, inner).at_mm));
    const Vec3d b = apply(head_from_camera, wide(of(landmarks, outer).at_mm));
    const Vec3d middle = minus(times(plus(a, b), 0.5), Vec3d{0, 0, kBehindLidsMm});
    const RigidTransform left = from_face(views[0]), right = from_face(views[1]);
    const Eye eye{middle,
                  {BallPicture(views[0], left, middle), BallPicture(views[1], right, middle)},
                  (camera_deg(left, middle) + camera_deg(right, middle)) / 2};
    for (const BallPicture& picture : eye.first)
      seen.iris_contrast = std::max(seen.iris_contrast.value_or(-1), picture.contrast(eye.first_deg));
    for (std::size_t k = 2; k + 1 < views.size(); k += 2)
      for (std::size_t side = 0; side < 2; ++side)
        votes.at(k / 2).add(eye, side, views[k + side], from_face(views[k + side]));
  }
  double sum = 0;
  int poses = 0;
  for (const PoseVotes& pose : votes)
    if (const auto following = pose.following()) {
      sum += *following;
      ++poses;
    }
  if (poses > 0) seen.eyes_follow = sum / poses;
  return seen;
}

}  // namespace relievo::pipeline
