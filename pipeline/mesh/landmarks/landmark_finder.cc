// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/landmark_finder.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/landmarks/face_profile.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// Where a pit is looked for: mean and deviation, mm in the head frame, on the person's left.
struct Expected {
  double x, y, sigma_x, sigma_y;
};

constexpr double kCellMm = 1, kSmoothMm = 1.5;
constexpr ReliefBox kBox{-62, 62, -78, 62, kCellMm};
constexpr int kSpan = 2;           // cells between the heights of a second difference
constexpr double kPitWorth = 25;   // of one unit of bend (1 / mm), against half a squared deviation
constexpr double kOwnReachMm = 3;  // a side's own pit lies that near the place of both
constexpr double kFissureMm = 30.8, kFissureRiseMm = 1.5;  // Farkas: ex - en
constexpr double kNasionOverCanthus = 3;                   // sellion lies that much higher than en
constexpr double kStomionBelowSubnasale = 21;

// Sigmas, mm, each coordinate.
constexpr float kTipSigma = 0.7F, kNasionSigma = 1.7F, kSubnasaleSigma = 1.5F, kChinSigma = 1.7F,
                kRecedingChinSigma = 3;
constexpr float kInnerEyeSigma = 2.0F, kOuterEyeSigma = 4.0F, kMouthSigma = 3.0F, kLidCornerSigma = 1.5F;
constexpr float kCompleted = 2;  // times as uncertain where the surface was not measured

// The lesser of the two bends of a hollow: positive only where the surface is a pit. 1 / mm.
double pit(const FaceRelief& relief, int column, int row) {
  const auto z = [&](int dc, int dr) { return double(relief.z(column + dc * kSpan, row + dr * kSpan)); };
  const double step = kSpan * kCellMm;
  const double xx = (z(1, 0) - 2 * z(0, 0) + z(-1, 0)) / (step * step);
  const double yy = (z(0, 1) - 2 * z(0, 0) + z(0, -1)) / (step * step);
  const double xy = (z(1, 1) - z(-1, 1) - z(1, -1) + z(-1, -1)) / (4 * step * step);
  return 0.5 * (xx + yy) -
         std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);  // NaN where something is missing
}

// The most pit-like and most expected place within the window.
bool find_pit(const FaceRelief& relief, const Expected& e, double reach, Vec2d& best) {
  double best_score = -1e9;
  for (int row = kSpan; row < relief.rows() - kSpan; ++row)
    for (int column = kSpan; column < relief.columns() - kSpan; ++column) {
      const double u = (relief.x_mm(column) - e.x) / e.sigma_x, v = (relief.y_mm(row) - e.y) / e.sigma_y;
      if (u * u + v * v > reach * reach) continue;
      const double bend = pit(relief, column, row);
      const double score = kPitWorth * bend - 0.5 * (u * u + v * v);
      if (std::isnan(bend) || score <= best_score) continue;
      best_score = score;
      best = {relief.x_mm(column), relief.y_mm(row)};
    }
  return best_score > -1e8;
}

class Finder {
 public:
  using Eyes = std::array<std::optional<Lids>, 2>;
  Finder(const FaceMesh& mesh, const RigidTransform& head_from_camera, const Eyes& eyes,
         StageContext& context)
      : camera_from_head_(inverse(head_from_camera)),
        own_(kBox, &context.scratch),
        both_(kBox, &context.scratch),
        shown_(kBox, &context.scratch),
        eyes_(eyes),
        measured_(profile_of(mesh, head_from_camera, &context.scratch)),
        marks_(find_profile_marks(profile_of(mesh, head_from_camera, &context.scratch, true))) {
    FaceRelief::add_both(mesh, head_from_camera, own_, shown_, context);
    both_ = own_;  // keeps its own memory
    both_.symmetrise();
    for (FaceRelief* relief : {&own_, &both_, &shown_}) relief->smooth(kSmoothMm, &context.scratch);
  }

  Landmarks find() {
    // The frame's origin is the tip, once the profile has one there.
    if (marks_.tip) mark(LandmarkName::Pronasale, ProfilePoint{}, kTipSigma);
    mark(LandmarkName::Nasion, marks_.nasion, kNasionSigma);
    mark(LandmarkName::Subnasale, marks_.subnasale, kSubnasaleSigma);
    mark(LandmarkName::Pogonion, marks_.chin, marks_.chin_recedes ? kRecedingChinSigma : kChinSigma);
    eyes();
    mouth();
    return found_;
  }

 private:
  void set(LandmarkName name, const Vec3d& in_head, float sigma_mm) {
    found_[std::size_t(name)] = {narrow(apply(camera_from_head_, in_head)), sigma_mm, true};
  }
  void mark(LandmarkName name, const std::optional<ProfilePoint>& at, float sigma_mm) {
    if (!at) return;
    const bool measured = std::ranges::any_of(
        measured_, [&](const ProfilePoint& p) { return std::abs(p.y_mm - at->y_mm) < kCellMm; });
    set(name, {0, at->y_mm, at->z_mm}, measured ? sigma_mm : kCompleted * sigma_mm);
  }
  void on_surface(LandmarkName name, const Vec2d& at, float sigma_mm) {
    const double z = shown_.at(at.x, at.y);
    const bool measured = !std::isnan(own_.at(at.x, at.y));
    if (!std::isnan(z)) set(name, {at.x, at.y, z}, measured ? sigma_mm : kCompleted * sigma_mm);
  }

  // Both sides' common place first, then each side's own near it.
  void pair(const Expected& e, LandmarkName right, LandmarkName left, float sigma_mm, Vec2d& common) {
    if (!find_pit(both_, e, 2.5, common)) return;
    for (const double side : {-1.0, 1.0}) {
      Vec2d own{side * common.x, common.y};
      find_pit(own_, {own.x, own.y, kOwnReachMm, kOwnReachMm}, 1, own);
      on_surface(side < 0 ? right : left, own, sigma_mm);
    }
  }

  void eyes() {
    const double y = marks_.nasion ? marks_.nasion->y_mm - kNasionOverCanthus : 34;
    Vec2d inner{16, y};
    pair({16, y, 3, 4}, LandmarkName::EndocanthionRight, LandmarkName::EndocanthionLeft, kInnerEyeSigma,
         inner);
    const Vec2d outer{inner.x + kFissureMm - 1, inner.y + kFissureRiseMm};
    on_surface(LandmarkName::ExocanthionRight, {-outer.x, outer.y}, kOuterEyeSigma);
    on_surface(LandmarkName::ExocanthionLeft, outer, kOuterEyeSigma);
    // Where a photograph shows the lids, their corners are better known.
    for (const bool left : {false, true}) {
      const auto& lids = eyes_[left ? 1 : 0];
      if (!lids) continue;
      on_surface(left ? LandmarkName::EndocanthionLeft : LandmarkName::EndocanthionRight, lids->inner,
                 kLidCornerSigma);
      on_surface(left ? LandmarkName::ExocanthionLeft : LandmarkName::ExocanthionRight, lids->outer,
                 kLidCornerSigma);
    }
  }

  void mouth() {
    const double y = marks_.subnasale ? marks_.subnasale->y_mm - kStomionBelowSubnasale : -34;
    Vec2d corner;
    pair({26, y, 3.5, 3.5}, LandmarkName::CheilionRight, LandmarkName::CheilionLeft, kMouthSigma, corner);
  }

  RigidTransform camera_from_head_;
  FaceRelief own_, both_, shown_;  // measured, each side and the mean of both; with what was completed
  Eyes eyes_;
  std::pmr::vector<ProfilePoint> measured_;  // of the profile; its marks are found on the completed one
  ProfileMarks marks_;
  Landmarks found_{};
};

}  // namespace

Result<Landmarks> find_landmarks(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                 const std::array<std::optional<Lids>, 2>& eyes, StageContext& context) {
  if (context.stop()) return stopped();
  const Arena::Mark mark(context.scratch);
  return Finder(mesh, head_from_camera, eyes, context).find();
}

}  // namespace relievo::pipeline
