// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/coarse_surface.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/coarse/two_way.h"

namespace relievo::pipeline {
namespace {

// Labels surfaces whose neighbouring disparities differ by less than `step`; returns the largest.
struct Largest { int label = 0; int size = 0; };

Largest label_surfaces(const Plane<float>& d, const Plane<std::uint8_t>& allowed, float step, Plane<int>& label,
                       std::pmr::memory_resource& scratch) {
  Largest best;
  int next = 0;
  std::pmr::vector<int> open(&scratch);
  open.reserve(d.values.size());
  for (std::size_t seed = 0; seed < d.values.size(); ++seed) {
    if (label.values[seed] != 0 || allowed.values[seed] == 0 || d.values[seed] == kNoDisparity) continue;
    ++next;
    int size = 0;
    open.clear();
    open.push_back(static_cast<int>(seed));
    label.values[seed] = next;
    while (!open.empty()) {
      const int k = open.back();
      open.pop_back();
      ++size;
      const int x = k % d.width;
      const int y = k / d.width;
      const int neighbours[4] = {x > 0 ? k - 1 : -1, x + 1 < d.width ? k + 1 : -1, y > 0 ? k - d.width : -1,
                                 y + 1 < d.height ? k + d.width : -1};
      for (const int n : neighbours) {
        if (n < 0) continue;
        const auto at = static_cast<std::size_t>(n);
        if (label.values[at] != 0 || allowed.values[at] == 0 || d.values[at] == kNoDisparity) continue;
        if (std::abs(d.values[at] - d.values[static_cast<std::size_t>(k)]) > step) continue;
        label.values[at] = next;
        open.push_back(n);
      }
    }
    if (size > best.size) best = {next, size};
  }
  return best;
}

// Holes that the surface encloses are bridged smoothly, so that refinement can look there: highlights
// and plain skin fail the cross-check and may still be found from their surroundings. What the finer
// pictures do not confirm keeps a large sigma and goes; what is hidden from the right view breaks the
// uniqueness rule and goes.
void bridge_holes(SurfaceField& field, const Plane<std::uint8_t>& usable, int largest, std::pmr::memory_resource& scratch) {
  const int w = field.domain.width;
  const int h = field.domain.height;
  Plane<std::uint8_t> seen(&scratch, w, h);
  std::pmr::vector<int> hole(&scratch);
  hole.reserve(seen.values.size());
  for (int seed = 0; seed < w * h; ++seed) {
    if (seen.values[static_cast<std::size_t>(seed)] != 0 || field.domain.values[static_cast<std::size_t>(seed)] != 0) continue;
    hole.clear();
    hole.push_back(seed);
    seen.values[static_cast<std::size_t>(seed)] = 1;
    bool enclosed = true;
    double sum = 0;
    double rim = 0;
    for (std::size_t next = 0; next < hole.size(); ++next) {
      const int k = hole[next];
      const int x = k % w;
      const int y = k / w;
      if (x == 0 || y == 0 || x == w - 1 || y == h - 1 || usable.values[static_cast<std::size_t>(k)] == 0) {
        enclosed = false;
        continue;
      }
      for (const int n : {k - 1, k + 1, k - w, k + w}) {
        const auto at = static_cast<std::size_t>(n);
        if (field.domain.values[at] == 1) {
          sum += static_cast<double>(field.disparity_px.values[at]);
          ++rim;
        } else if (seen.values[at] == 0) {
          seen.values[at] = 1;
          hole.push_back(n);
        }
      }
    }
    if (!enclosed || static_cast<int>(hole.size()) > largest || rim == 0) continue;
    for (const int k : hole) field.disparity_px.values[static_cast<std::size_t>(k)] = static_cast<float>(sum / rim);
    // A soap film over the rim; a few dozen sweeps do for holes this small.
    for (int sweep = 0; sweep < 60; ++sweep)
      for (const int k : hole) {
        const float* d = field.disparity_px.values.data() + k;
        field.disparity_px.values[static_cast<std::size_t>(k)] = 0.25F * (d[-1] + d[1] + d[-w] + d[w]);
      }
    for (const int k : hole) field.domain.values[static_cast<std::size_t>(k)] = 2;  // not a rim for the next hole
  }
  for (std::uint8_t& inside : field.domain.values) inside = inside != 0 ? 1 : 0;
}

}  // namespace

Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context, SurfaceField& field) {
  const PyramidLevel& left3 = pyramids.left[kCoarseLevel];
  const PyramidLevel& right3 = pyramids.right[kCoarseLevel];
  const double nearest = pair.disparity_px(pair.near_mm);
  const double farthest = pair.disparity_px(pair.far_mm);
  const int first3 = static_cast<int>(std::floor(farthest / 8)) - 1;
  const int count3 = static_cast<int>(std::ceil(nearest / 8)) + 1 - first3;
  TwoWay coarse(&context.scratch, left3.grey.width, left3.grey.height);
  std::fill(coarse.first_left.values.begin(), coarse.first_left.values.end(), static_cast<std::int16_t>(first3));
  std::fill(coarse.first_right.values.begin(), coarse.first_right.values.end(), static_cast<std::int16_t>(first3));
  {
    Arena::Mark mark(context.scratch);
    RELIEVO_TRY(match_both(left3, right3, count3, options.costs, context, coarse));
    cross_check(coarse.left, coarse.right, 1.5F);
    median3(coarse.left, context.scratch);
    median3(coarse.right, context.scratch);
  }
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching coarsely"};
  const PyramidLevel& left2 = pyramids.left[kFineLevel];
  const PyramidLevel& right2 = pyramids.right[kFineLevel];
  const int w = left2.grey.width;
  const int h = left2.grey.height;
  TwoWay fine(&context.scratch, w, h);
  predict(coarse.left, options.band, 2 * first3, 2 * (first3 + count3), fine.first_left);
  predict(coarse.right, options.band, 2 * first3, 2 * (first3 + count3), fine.first_right);
  {
    Arena::Mark mark(context.scratch);
    RELIEVO_TRY(match_both(left2, right2, options.band, options.costs, context, fine));
  }
  cross_check(fine.left, fine.right, options.cross_check_px);
  median3(fine.left, context.scratch);

  Plane<std::uint8_t> allowed(&context.scratch, w, h, 1);
  if (!pair.region.empty())
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        allowed.row(y)[x] = pair.region[static_cast<std::size_t>(std::min(4 * y, pair.height_px - 1)) * static_cast<std::size_t>(pair.width_px) +
                                        static_cast<std::size_t>(std::min(4 * x, pair.width_px - 1))];
  Plane<int> label(&context.scratch, w, h);
  const Largest face = label_surfaces(fine.left, allowed, options.step_limit_px, label, context.scratch);
  if (face.size < 400)
    return Error{Errc::TooFewMatches, "no surface of a face's size between the near and far limits: is the face in both views and the calibration this rig's?"};
  for (std::size_t k = 0; k < label.values.size(); ++k) {
    field.domain.values[k] = label.values[k] == face.label ? 1 : 0;
    field.disparity_px.values[k] = field.domain.values[k] != 0 ? 4 * fine.left.values[k] : 0.0F;
  }
  for (std::size_t k = 0; k < allowed.values.size(); ++k) allowed.values[k] &= left2.valid.values[k];
  bridge_holes(field, allowed, options.largest_hole, context.scratch);
  return {};
}

}  // namespace relievo::pipeline
