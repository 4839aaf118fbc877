// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/refined_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "pipeline/match/epipolar/row_aligner.h"
#include "pipeline/match/region/face_reach.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr long kMostPixels = 1'000'000;  // four times as many are matched in the memory for any picture
// At a quarter of a pixel beyond the second.
constexpr std::array<float, 4> kCubic{-0.0703125F, 0.8671875F, 0.2265625F, -0.0234375F};

// Of what the fit to the enlarged pair holds for certain: half of it for the size, times root two because
// pixels that were put between others say nothing of their own (of four rendered heads, 0.66 to 0.71 and 0.93
// to 0.95 then lie within one and 1.96 sigma).
constexpr float kSigma = 0.70710678F;

// The old pixel `step` pixels (-1 .. 2, away from the nearest) from new pixel `at`; at the border the last.
int tap(int at, int step, int size) {
  const int nearest = at / 2;
  return std::clamp((at & 1) != 0 ? nearest + step : nearest - step, 0, size - 1);
}

void enlarge_view(const RectifiedView& from, int width, int height, RectifiedView& to) {
  const auto w = std::size_t(width);
  const auto h = std::size_t(height);
  to.grey.assign(4 * w * h, 0.0F);
  to.valid.assign(4 * w * h, 0);
  std::pmr::vector<float> row(w, to.grey.get_allocator());
  for (int y = 0; y < 2 * height; ++y) {
    std::ranges::fill(row, 0.0F);
    for (std::size_t k = 0; k < kCubic.size(); ++k) {
      const float* old = &from.grey[std::size_t(tap(y, int(k) - 1, height)) * w];
      for (std::size_t x = 0; x < w; ++x) row[x] += kCubic[k] * old[x];
    }
    float* grey = &to.grey[std::size_t(y) * 2 * w];
    std::uint8_t* valid = &to.valid[std::size_t(y) * 2 * w];
    const std::uint8_t* was_valid = &from.valid[std::size_t(y / 2) * w];
    for (int x = 0; x < 2 * width; ++x) {
      float sum = 0;
      for (std::size_t k = 0; k < kCubic.size(); ++k)
        sum += kCubic[k] * row[std::size_t(tap(x, int(k) - 1, width))];
      grey[x] = std::clamp(sum, 0.0F, 255.0F);
      valid[x] = was_valid[x / 2];
    }
  }
}

// Old pixel centres in new pixels, and back.
double larger(double at) { return 2 * at + 0.5; }
double smaller(double at) { return (at - 0.5) / 2; }

constexpr int kLevels = 4;
constexpr int kNodeStepPx = 2;  // the final lattice
// Rows that disagree by half a pixel of a quarter of the size mislead the coarse surface: once more.
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

// Bilinear between four nodes of the domain, or at its rim the nearest.
bool read_field(const SurfaceField& field, Vec2f at, Match& match) {
  const float fx = at.x / float(field.step_px);
  const float fy = at.y / float(field.step_px);
  const int x = int(fx);
  const int y = int(fy);
  if (fx < 0 || fy < 0 || x >= field.domain.width || y >= field.domain.height) return false;
  const int near_x = std::min(int(std::lround(fx)), field.domain.width - 1);
  const int near_y = std::min(int(std::lround(fy)), field.domain.height - 1);
  if (field.domain.row(near_y)[near_x] == 0) return false;
  match.disparity_px = field.disparity_px.row(near_y)[near_x];
  match.sigma_px = field.sigma_px.row(near_y)[near_x];
  match.cost = field.cost.row(near_y)[near_x];
  const float tx = fx - float(x);
  const float ty = fy - float(y);
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

// What is left of a lamp's image once it was taken out misleads all pixels one way, which the residuals do
// not show: by an angle, however large the pixels are, that grows with the light, the more slowly the more
// there is; with pores' mirror images left in it, more of it and for longer (of simulated people in full and
// half size, and as single-chip cameras and JPEG show them). Variance of the disparity.
float mirrored_variance_px2(const RectifiedPair& pair, const Match& match) {
  const float pores = (pair.left.pores_left + pair.right.pores_left) / 2;
  const float most_px = (5.6e-5F + 6.7e-5F * pores) * float(pair.focal_px);
  const float half = 9 + 11 * pores;  // grey levels at half of its square
  const auto squared = [&](const RectifiedView& view, float x) {
    const int column = std::clamp(int(std::lround(x)), 0, pair.width_px - 1);
    const int row = std::clamp(int(std::lround(match.left_px.y)), 0, pair.height_px - 1);
    const float light = view.mirrored.empty() ? 0.0F : float(view.mirrored[pair.index(column, row)]);
    return light * light;
  };
  const float light =
      (squared(pair.left, match.left_px.x) + squared(pair.right, match.left_px.x - match.disparity_px)) / 2;
  return most_px * most_px * light / (light + half * half);
}

// What the field says at the keypoints.
void read_matches(const RectifiedPair& pair, const SurfaceField& field, const Keypoints& keypoints,
                  const RowMotion& motion, float sigma_limit_px, MatchSet& set) {
  const auto read = [&](const Keypoint& keypoint, Match& match) {
    match.left_px = keypoint.at_px;
    return read_field(field, keypoint.at_px, match) && match.sigma_px > 0 && match.sigma_px <= sigma_limit_px;
  };
  // Counted first: hardly half the keypoints of a region lie on the face.
  set.matches.reserve(std::size_t(std::ranges::count_if(keypoints.points, [&](const Keypoint& keypoint) {
    Match match;
    return read(keypoint, match);
  })));
  for (const Keypoint& keypoint : keypoints.points) {
    Match match;
    if (!read(keypoint, match)) continue;
    // What moved across the rows moved along them as well, for all we know.
    const double moved = motion.at(double(match.left_px.x - match.disparity_px), double(match.left_px.y));
    match.sigma_px = std::hypot(match.sigma_px, std::sqrt(mirrored_variance_px2(pair, match)), float(moved));
    set.matches.push_back(match);
  }
}

Result<MatchSet> match_at_size(const RefinedMatcher& o, const RectifiedPair& pair, const Keypoints& keypoints,
                               StageContext& context) {
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  Pyramids pyramids = build_pyramids(pair, kLevels, context);
  // Curvature k (1/mm) bends the disparity by k * baseline / focal a square pixel; a pixel covers
  // (z / focal)^2 square millimetres. Middle of the volume: the weight must not follow the noise.
  const double z = 2 / (1 / pair.near_mm + 1 / pair.far_mm);
  const double per_px = double(o.refiner.bending) * pair.baseline_mm / pair.focal_px;
  const double lambda = (z / pair.focal_px) * (z / pair.focal_px) / (per_px * per_px);
  const auto scene_at = [&](int level) {
    return RefinerScene{pyramids.left[std::size_t(level)].grey, pyramids.right[std::size_t(level)].grey,
                        pyramids.right[std::size_t(level)].valid, level, lambda};
  };
  const auto refine = [&](int level, SurfaceField& field) {
    return refine_surface(scene_at(level), o.refiner, context, field);
  };
  const auto& half = pyramids.left[1].grey;
  const auto& fine = pyramids.left[kFineLevel].grey;
  SurfaceField field2(&context.scratch, half.width, half.height, kNodeStepPx);
  RowAligner rows(pair, pyramids, double(o.align_beyond_px), o.follow_motion != 0, context);
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
  read_matches(pair, field2, keypoints, rows.motion(), o.sigma_limit_px, set);
  // Of a whole face 100 are hardly any; where few places were asked for, a tenth of them.
  if (set.matches.size() < std::clamp<std::size_t>(keypoints.points.size() / 10, 1, 100))
    return nothing_matches();
  return set;
}

}  // namespace

bool is_small_scene(const RectifiedPair& pair) {
  return pair.region.empty() && static_cast<long>(pair.width_px) * pair.height_px <= kMostPixels;
}

RectifiedPair enlarge(const RectifiedPair& pair, std::pmr::memory_resource* memory) {
  RectifiedPair made(memory);
  made.width_px = 2 * pair.width_px;
  made.height_px = 2 * pair.height_px;
  made.focal_px = 2 * pair.focal_px;
  made.baseline_mm = pair.baseline_mm;
  made.left_centre_px = {larger(pair.left_centre_px.x), larger(pair.left_centre_px.y)};
  made.right_centre_px = {larger(pair.right_centre_px.x), larger(pair.right_centre_px.y)};
  made.near_mm = pair.near_mm;
  made.far_mm = pair.far_mm;
  made.rectified_from_left = pair.rectified_from_left;
  made.rectified_from_right = pair.rectified_from_right;
  made.right_from_left = pair.right_from_left;
  enlarge_view(pair.left, pair.width_px, pair.height_px, made.left);
  enlarge_view(pair.right, pair.width_px, pair.height_px, made.right);
  return made;
}

Keypoints enlarge(const Keypoints& keypoints, std::pmr::memory_resource* memory) {
  Keypoints made(memory);
  made.lattice_step_px = 2 * keypoints.lattice_step_px;
  made.points.assign(keypoints.points.begin(), keypoints.points.end());
  for (Keypoint& point : made.points) point.at_px = {2 * point.at_px.x + 0.5F, 2 * point.at_px.y + 0.5F};
  return made;
}

void shrink(MatchSet& matches, int lattice_step_px) {
  for (Match& match : matches.matches) {
    match.left_px = {(match.left_px.x - 0.5F) / 2, (match.left_px.y - 0.5F) / 2};
    match.disparity_px /= 2;
    match.sigma_px *= kSigma;
  }
  EpipolarShift& shift = matches.epipolar_shift;
  shift.middle_x_px = smaller(shift.middle_x_px);
  shift.middle_y_px = smaller(shift.middle_y_px);
  for (double* length :
       {&shift.offset_px, &shift.spread_x_px, &shift.spread_y_px, &shift.residual_px, &shift.sigma_px})
    *length /= 2;
  for (double& v : shift.covariance_px2) v /= 4;
  matches.motion_px /= 2;
  matches.lattice_step_px = lattice_step_px;
}

Result<MatchSet> RefinedMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                       StageContext& context) const {
  if (pair.width_px < 64 || pair.height_px < 64 || pair.left.grey.empty() || pair.right.grey.empty())
    return invalid("the rectified pair is smaller than 64 pixels");
  if (!is_small_scene(pair)) return match_at_size(*this, pair, keypoints, context);
  RELIEVO_TRY_ASSIGN(MatchSet found, match_at_size(*this, enlarge(pair, &context.scratch),
                                                   enlarge(keypoints, &context.scratch), context));
  shrink(found, keypoints.lattice_step_px);
  return found;
}

}  // namespace relievo::pipeline
