// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of a rough surface lies within reach of the face: shoulders, collar and neck need not be refined,
// since they are cropped later (reconstruct/face_crop.h); on some pictures they are a third of all. Memory:
// scratch only. Thread: any; deterministic.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Weighted least squares of three terms, value = k0 * t0 + k1 * t1 + k2 * t2, from sums. Thread: one caller.
class ThreeTerms {
 public:
  void add(const std::array<double, 3>& terms, double value, double weight = 1);
  // k; nothing where what was added does not fix all three.
  std::optional<std::array<double, 3>> solve() const;

 private:
  std::array<double, 6> products_{};  // 00 01 02 11 12 22
  std::array<double, 3> values_{};
};

// Where, in shares of the face's width around its middle, every nose is: 38 mm on a grown-up.
inline constexpr double kNoseReach = 0.25;

// The tip of the nose, however the head is turned or bowed: the mean of the hundredth of points (for a single
// stray point is none) that stands out furthest towards the cameras from the plane that the rest of them lies
// about. Any frame whose z leads away from the cameras; reorders the points, 10 at least.
Vec3d outstanding_tip(std::span<Vec3d> middle);
// The same where only the first `candidates` of the points, 10 or more, can be the tip.
Vec3d outstanding_tip(std::span<Vec3d> middle, std::size_t candidates);

// Is a pixel of the left view where a nose may be? It lies 0.05 to 0.17 of the face's width below the middle
// of its box, 0.3 when the head is bowed by 15 degrees.
bool may_be_nose(const RectifiedPair& pair, double x_px, double y_px);

// Takes nodes out of the domain that lie further than pair.face_reach_mm from the surface nearest to the
// cameras in the middle of the face. Nothing where no face was looked for, or hardly anything lies there.
void keep_within_reach(const RectifiedPair& pair, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline
