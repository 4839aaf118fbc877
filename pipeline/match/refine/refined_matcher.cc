// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/refined_matcher.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/coarse/coarse_surface.h"
#include "pipeline/match/epipolar/row_aligner.h"
#include "pipeline/match/refine/detail_search.h"
#include "pipeline/match/refine/enlarged_scene.h"
#include "pipeline/match/refine/occluding_contour.h"
#include "pipeline/match/region/face_reach.h"

namespace relievo::pipeline {
namespace {

constexpr int kLevels = 4;
constexpr int kNodeStepPx = 2;  // the final lattice
// Rows further apart than half a pixel of a quarter of the size mislead the coarse surface: it is looked for
// again.
constexpr double kSearchAgainPx = 2;
constexpr int kPasses = 2;
constexpr int kLooks = 4;  // for what lies further off than one search reaches

// The field on a lattice twice as dense: bilinear inside, nearest at the edge.
void densify(const SurfaceField& from, SurfaceField& to) {
  for (int y = 0; y < to.domain.height; ++y)
    for (int x = 0; x < to.domain.width; ++x) {
      const int i = std::min(x / 2, from.domain.width - 1);
      const int j = std::min(y / 2, from.domain.height - 1);
      to.domain.row(y)[x] = from.domain.row(j)[i];
      if (to.domain.row(y)[x] == 0) continue;
      const int right = std::min(i + (x & 1), from.domain.width - 1);
      const int below = std::min(j + (y & 1), from.domain.height - 1);
      const bool whole =
          (from.domain.row(j)[right] & from.domain.row(below)[i] & from.domain.row(below)[right]) != 0;
      const float here = from.disparity_px.row(j)[i];
      to.disparity_px.row(y)[x] =
          !whole ? here
                 : 0.25F * (here + from.disparity_px.row(j)[right] + from.disparity_px.row(below)[i] +
                            from.disparity_px.row(below)[right]);
    }
}

double bending_weight(const RectifiedPair& pair, float bending) {
  // Curvature k (1/mm) bends the disparity by k * baseline / focal a square pixel; a pixel covers
  // (z / focal)^2 square millimetres. Middle of the volume: the weight must not follow the noise.
  const double z = 2 / (1 / pair.near_mm + 1 / pair.far_mm);
  const double per_px = bending * pair.baseline_mm / pair.focal_px;
  return (z / pair.focal_px) * (z / pair.focal_px) / (per_px * per_px);
}

// Bilinear between four nodes of the domain, or at its rim the nearest.
bool read_field(const SurfaceField& field, Vec2f at, Match& match) {
  const float fx = at.x / static_cast<float>(field.step_px);
  const float fy = at.y / static_cast<float>(field.step_px);
  const int x = static_cast<int>(fx);
  const int y = static_cast<int>(fy);
  if (fx < 0 || fy < 0 || x >= field.domain.width || y >= field.domain.height) return false;
  const int near_x = std::min(static_cast<int>(std::lround(fx)), field.domain.width - 1);
  const int near_y = std::min(static_cast<int>(std::lround(fy)), field.domain.height - 1);
  if (field.domain.row(near_y)[near_x] == 0) return false;
  match.disparity_px = field.disparity_px.row(near_y)[near_x];
  match.sigma_px = field.sigma_px.row(near_y)[near_x];
  match.cost = field.cost.row(near_y)[near_x];
  const float tx = fx - static_cast<float>(x);
  const float ty = fy - static_cast<float>(y);
  if (tx == 0 && ty == 0) return true;
  if (x + 1 >= field.domain.width || y + 1 >= field.domain.height) return true;
  const float* upper = field.disparity_px.row(y) + x;
  const float* lower = field.disparity_px.row(y + 1) + x;
  if ((field.domain.row(y)[x] & field.domain.row(y)[x + 1] & field.domain.row(y + 1)[x] &
       field.domain.row(y + 1)[x + 1]) == 0)
    return true;
  const float top = upper[0] + tx * (upper[1] - upper[0]);
  match.disparity_px = top + ty * (lower[0] + tx * (lower[1] - lower[0]) - top);
  return true;
}

// What the field says at the keypoints.
void read_matches(const SurfaceField& field, const Keypoints& keypoints, const RowMotion& motion,
                  float sigma_limit_px, MatchSet& set) {
  const auto read = [&](const Keypoint& keypoint, Match& match) {
    match.left_px = keypoint.at_px;
    return read_field(field, keypoint.at_px, match) && match.sigma_px > 0 && match.sigma_px <= sigma_limit_px;
  };
  // Counted first: hardly half the keypoints of a region lie on the face.
  set.matches.reserve(static_cast<std::size_t>(
      std::count_if(keypoints.points.begin(), keypoints.points.end(), [&](const Keypoint& keypoint) {
        Match match;
        return read(keypoint, match);
      })));
  for (const Keypoint& keypoint : keypoints.points) {
    Match match;
    if (!read(keypoint, match)) continue;
    // What moved across the rows moved along them as well, for all we know.
    const double moved = motion.at(static_cast<double>(match.left_px.x - match.disparity_px),
                                   static_cast<double>(match.left_px.y));
    match.sigma_px = std::hypot(match.sigma_px, static_cast<float>(moved));
    set.matches.push_back(match);
  }
}

Result<MatchSet> match_at_size(const RefinedMatcher& o, const RectifiedPair& pair, const Keypoints& keypoints,
                               StageContext& context) {
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  Pyramids pyramids = build_pyramids(pair, kLevels, context);
  const double lambda = bending_weight(pair, o.refiner.bending);
  const auto scene_at = [&](int level) {
    return RefinerScene{pyramids.left[static_cast<std::size_t>(level)].grey,
                        pyramids.right[static_cast<std::size_t>(level)].grey,
                        pyramids.right[static_cast<std::size_t>(level)].valid, level, lambda};
  };
  const auto refine = [&](int level, SurfaceField& field) {
    return refine_surface(scene_at(level), o.refiner, context, field);
  };
  const auto& half = pyramids.left[1].grey;
  const auto& fine = pyramids.left[kFineLevel].grey;
  SurfaceField field2(&context.scratch, half.width, half.height, kNodeStepPx);
  RowAligner rows(pair, pyramids, {static_cast<double>(o.align_beyond_px), o.follow_motion != 0}, context);
  for (int pass = 0; pass < kPasses; ++pass) {
    if (is_scene(pair)) {
      Arena::Mark mark(context.scratch);
      RELIEVO_TRY(find_coarse_surface(pair, pyramids, o.coarse, context, field2));
    } else {
      Arena::Mark mark(context.scratch);
      SurfaceField field4(&context.scratch, fine.width, fine.height, 1 << kFineLevel);
      RELIEVO_TRY(find_coarse_surface(pair, pyramids, o.coarse, context, field4));
      context.progress.done.store(0.4F, std::memory_order_relaxed);
      RELIEVO_TRY(refine(kFineLevel, field4));
      keep_within_reach(pair, context, field4);
      densify(field4, field2);
    }
    if (rows.align(field2) < kSearchAgainPx) break;
  }
  if (!is_scene(pair)) {
    RELIEVO_TRY(search_edges(pair, pyramids, o.coarse, context, field2));
    keep_within_reach(pair, context, field2);
  }
  RELIEVO_TRY(refine(1, field2));
  for (int look = 0; look < kLooks && search_by_detail(scene_at(1), context, field2); ++look)
    RELIEVO_TRY(refine(1, field2));
  cut_at_occluding_contours(scene_at(1), context, field2);
  if (rows.motion().seen) rows.align_motion(field2);
  context.progress.done.store(0.6F, std::memory_order_relaxed);
  RELIEVO_TRY(refine(0, field2));
  set.epipolar_shift = rows.measure_linear(field2);
  set.motion_px = rows.motion().rms_px;
  read_matches(field2, keypoints, rows.motion(), o.sigma_limit_px, set);
  // Of a whole face 100 are hardly any; where few places were asked for, a tenth of them.
  if (set.matches.size() < std::clamp<std::size_t>(keypoints.points.size() / 10, 1, 100))
    return Error{Errc::TooFewMatches,
                 "hardly anything matches between the views: is the face in both, in focus and lit?"};
  return set;
}

}  // namespace

Result<MatchSet> RefinedMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                       StageContext& context) const {
  if (pair.width_px < 64 || pair.height_px < 64 || pair.left.grey.empty() || pair.right.grey.empty())
    return Error{Errc::InvalidInput, "the rectified pair is smaller than 64 pixels"};
  if (!is_small_scene(pair)) return match_at_size(*this, pair, keypoints, context);
  RELIEVO_TRY_ASSIGN(MatchSet found, match_at_size(*this, enlarge(pair, &context.scratch),
                                                   enlarge(keypoints, &context.scratch), context));
  shrink(found, keypoints.lattice_step_px);
  return found;
}

}  // namespace relievo::pipeline
