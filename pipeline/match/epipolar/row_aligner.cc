// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "pipeline/base/solving.h"
#include "pipeline/match/image/plane_filters.h"

namespace relievo::pipeline {
namespace {

// Between two rows of a picture: Keys' cubic convolution of fourth order over six rows (1981, section VI).
// The usual one over four moves fine detail a tenth too little: a shift measured with it is a tenth too
// large.
inline constexpr int kColumnReach = 3;  // rows needed on either side

struct ColumnWeights {
  // t in [0, 1): the way from the row above to the one below.
  explicit ColumnWeights(float t)
      : w{outer(t), middle(t), inner(t), inner(1 - t), middle(1 - t), outer(1 - t)} {}
  float sample(const float* above, std::ptrdiff_t stride) const {
    return w[0] * above[-2 * stride] + w[1] * above[-stride] + w[2] * above[0] + w[3] * above[stride] +
           w[4] * above[2 * stride] + w[5] * above[3 * stride];
  }

 private:
  static float inner(float s) { return 1 + s * s * (4.0F / 3 * s - 7.0F / 3); }  // at distance s
  static float middle(float s) { return s * (-2.0F / 3 + s * (15.0F / 12 - 7.0F / 12 * s)); }  // at 1 + s
  static float outer(float s) { return s * (1.0F / 12 + s * (-2.0F / 12 + 1.0F / 12 * s)); }   // at 2 + s
  float w[6];
};

constexpr int kBands = 16;
constexpr int kRadius = 6;         // detail is what remains without the mean over this reach, level pixels
constexpr int kPatchPx = 8;        // side of a patch, level pixels
constexpr int kLeastSamples = 24;  // of the 64 pixels of a patch
constexpr float kSaturated = 250;  // grey: a highlight moves with the viewer
// grey^2 a patch: half a grey level a pixel, what is left of the slope when all else is taken out.
constexpr double kLeastInformation = 16;
// Shares of the face's width (150 mm): from temple to temple, from the brows' upper edge to the chin.
constexpr double kHalfWidth = 0.45;
constexpr double kHalfHeight = 0.54;

// Shading and offset differ between the views, detail does not.
void high_pass(const Plane<float>& from, StageContext& context, Plane<float>& to) {
  Arena::Mark mark(context.scratch);
  Plane<float> across(&context.scratch, from.width, from.height);
  box_sum(from, kRadius, context.pool, across, to);
  constexpr float kScale = 1.0F / ((2 * kRadius + 1) * (2 * kRadius + 1));
  for (std::size_t k = 0; k < to.values.size(); ++k) to.values[k] = from.values[k] - kScale * to.values[k];
}

int patches_over(int nodes, int stride) { return (nodes + kPatchPx * stride - 1) / (kPatchPx * stride); }

// Where the patches with something to say begin and end: the blocks are laid over that.
struct Extent {
  int begin = 1 << 20, end = 0;
  void include(int at) {
    begin = std::min(begin, at);
    end = std::max(end, at + 1);
  }
  int block(int at) const { return (at - begin) * kShiftBlocksAcross / (end - begin); }
};

// Of the left view, where hair and neck are not; everywhere where no face was looked for.
Ellipse middle_of_face(const RectifiedPair& pair) {
  const double width = pair.face_width_px > 0 ? pair.face_width_px : std::numeric_limits<double>::infinity();
  return {pair.face_centre_px.x, pair.face_centre_px.y, kHalfWidth * width, kHalfHeight * width};
}

// What each patch of the face says about the shift across the rows there (Lucas and Kanade 1981), at
// one size of the pictures. Within a patch its slip along the rows, gain and offset of brightness are
// eliminated. The gradient is the left view's alone: its noise and the residual's have nothing to do
// with each other, so the estimate is not drawn towards whole or half rows.
class LocalShifts {
 public:
  // All are borrowed and must outlive this.
  LocalShifts(const Pyramids& pyramids, int level, const SurfaceField& field, const Ellipse& face,
              StageContext& context)
      : left_(pyramids.left[std::size_t(level)]),
        right_(pyramids.right[std::size_t(level)]),
        field_(field),
        face_(face),
        context_(context),
        level_(level) {
    high_pass(left_.grey, context, left_detail_);
    high_pass(right_.grey, context, right_detail_);
  }

  // Valid until the next call.
  std::span<const LocalShift> measure(const RowShift& from) {
    gather(from);
    Extent across, down;
    for (int q = 0; q < patches_.height; ++q)
      for (int p = 0; p < patches_.width; ++p)
        if (patches_.row(q)[p].samples >= kLeastSamples) across.include(p), down.include(q);
    std::size_t count = 0;
    double left2 = 0, right2 = 0;
    for (int q = down.begin; q < down.end; ++q)
      for (int p = across.begin; p < across.end; ++p) {
        const Patch& patch = patches_.row(q)[p];
        if (patch.samples < kLeastSamples) continue;
        const double* s = patch.sums;
        left2 += s[2];
        right2 += patch.right2;
        Eigen::Matrix3d nuisance;
        nuisance << s[0] + 1, s[1], s[3], s[1], s[2] + 1, s[4], s[3], s[4], s[5];
        const Eigen::Vector3d along(s[6], s[7], s[8]);
        const Eigen::Vector3d taken = solved<3>(nuisance, along);
        const double information = s[9] - taken.dot(along);
        if (!(information > kLeastInformation)) continue;
        const double x = patch.x / patch.samples, y = patch.y / patch.samples;
        const double step = (s[13] - taken.dot(Eigen::Vector3d(s[10], s[11], s[12]))) / information;
        locals_[count++] = {x, y, from.at(x, y) - (1 << level_) * step, information,
                            across.block(p) + kShiftBlocksAcross * down.block(q)};
      }
    if (left2 > 0) gain_ = std::clamp(std::sqrt(right2 / left2), 0.3, 3.0);
    return {locals_.data(), count};
  }

 private:
  // Order of the sums of a patch: lower triangle over slope_x, detail, 1, slope_y, residual.
  struct Patch {
    double sums[15] = {};
    double x = 0, y = 0, right2 = 0;
    int samples = 0;
  };

  void gather(const RowShift& from) {
    const int reach = kPatchPx * stride_;
    context_.pool.for_each(patches_.height, kBands, [&](int q) {
      for (int p = 0; p < patches_.width; ++p) {
        Patch& patch = patches_.row(q)[p] = {};
        const int j_end = std::min(field_.domain.height, (q + 1) * reach);
        const int i_end = std::min(field_.domain.width, (p + 1) * reach);
        for (int j = q * reach; j < j_end; j += stride_)
          for (int i = p * reach; i < i_end; i += stride_)
            if (field_.domain.row(j)[i] != 0 && face_.holds(i * field_.step_px, j * field_.step_px))
              add_node(from, i / stride_, j / stride_, double(field_.disparity_px.row(j)[i]), patch);
      }
    });
  }

  void add_node(const RowShift& from, int x, int y, double disparity_px, Patch& patch) const {
    const double scale = 1 << level_;
    const double xr = x - disparity_px / scale;
    const double yr = y + from.at(xr * scale, y * scale) / scale;
    const int ix = int(std::floor(xr));
    const int iy = int(std::floor(yr));
    constexpr int kMargin = kRadius + kColumnReach;
    const Plane<float>& l = left_detail_;
    const Plane<float>& r = right_detail_;
    if (ix < kMargin || iy < kMargin || ix + kMargin >= r.width || iy + kMargin >= r.height || x < kMargin ||
        y < kMargin || x + kMargin >= l.width || y + kMargin >= l.height)
      return;
    if (left_.grey.row(y)[x] > kSaturated || right_.grey.row(iy)[ix] > kSaturated) return;
    const auto tx = float(xr - ix);
    const ColumnWeights column(float(yr - iy));
    const float* at = r.row(iy) + ix;
    const double seen = double((1 - tx) * column.sample(at, r.width) + tx * column.sample(at + 1, r.width));
    const auto here = double(l.row(y)[x]);
    const double values[5] = {0.5 * (l.row(y)[x + 1] - l.row(y)[x - 1]), here, 1,
                              0.5 * (l.row(y + 1)[x] - l.row(y - 1)[x]), seen / gain_ - here};
    int k = 0;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j <= i; ++j) patch.sums[k++] += values[i] * values[j];
    patch.x += xr * scale;
    patch.y += y * scale;
    patch.right2 += seen * seen;
    ++patch.samples;
  }

  const PyramidLevel& left_;
  const PyramidLevel& right_;
  const SurfaceField& field_;
  const Ellipse& face_;
  StageContext& context_;
  int level_;
  int stride_{std::max(
      1, (1 << level_) / field_.step_px)};  // every so many nodes of the field are a pixel of this level
  double gain_ = 1;                         // of the right view over the left
  Plane<float> left_detail_{&context_.scratch, left_.grey.width, left_.grey.height};
  Plane<float> right_detail_{&context_.scratch, right_.grey.width, right_.grey.height};
  Plane<Patch> patches_{&context_.scratch, patches_over(field_.domain.width, stride_),
                        patches_over(field_.domain.height, stride_)};
  std::pmr::vector<LocalShift> locals_{patches_.values.size(), &context_.scratch};
};

constexpr int kFirstLevel = 3;
constexpr int kLastLevel = 1;     // full size would add noise, hardly detail
constexpr int kSearchRounds = 3;  // at each level
constexpr int kRefineRounds = 2;
constexpr int kMotionRounds = 10;  // a chin may move by many pixels, a round by one of half the size
constexpr double kMotionSettledPx = 0.02;

}  // namespace

EpipolarShift measure_epipolar_shift(const RectifiedPair& pair, const Pyramids& pyramids,
                                     const SurfaceField& field, EpipolarSearch search,
                                     StageContext& context) {
  const bool whole = search == EpipolarSearch::Search;
  const Ellipse face = middle_of_face(pair);
  EpipolarShift shift;
  for (int level = whole ? kFirstLevel : kLastLevel; level >= kLastLevel; --level) {
    Arena::Mark mark(context.scratch);
    LocalShifts locals(pyramids, level, field, face, context);
    for (int round = 0; round < (whole ? kSearchRounds : kRefineRounds); ++round) {
      // Small pictures have too few patches for slopes.
      const EpipolarShift better =
          fit_shift_field(locals.measure({shift}), level == kLastLevel, context.scratch);
      if (!better.measured()) break;
      shift = better;
    }
  }
  return shift;
}

void shift_rows(const RowShift& shift, std::span<const float> from, Plane<float>& to, StageContext& context) {
  context.pool.for_each(to.height, kBands, [&](int y) {
    for (int x = 0; x < to.width; ++x) {
      const double at = y + shift.at(x, y);
      const int k = int(std::floor(at));
      const bool inside = k >= kColumnReach && k + kColumnReach < to.height;
      const float* above = from.data() + std::ptrdiff_t(inside ? k : y) * to.width + x;
      to.row(y)[x] = inside ? ColumnWeights(float(at - k)).sample(above, to.width) : *above;
    }
  });
}

double RowAligner::align(const SurfaceField& field) {
  Arena::Mark mark(context_.scratch);
  measured_ = measure_epipolar_shift(pair_, pyramids_, field, EpipolarSearch::Search, context_);
  const RowMotion motion = measure_motion(field, measured_);
  const bool realign = measured_.residual_px > beyond_px_;
  if (!realign && !motion.seen) return 0;
  apply(realign ? &measured_ : nullptr, motion);
  return largest({realign ? measured_ : EpipolarShift{}, &motion});
}

void RowAligner::align_motion(const SurfaceField& field) {
  Arena::Mark mark(context_.scratch);
  const RowMotion motion = measure_motion(field, EpipolarShift{});
  if (motion.seen) apply(nullptr, motion);
}

RowMotion RowAligner::measure_motion(const SurfaceField& field, const EpipolarShift& linear) const {
  RowMotion motion(&context_.scratch, pair_.width_px, pair_.height_px);
  if (!follow_motion_) return motion;
  Arena::Mark mark(context_.scratch);
  const Ellipse face = middle_of_face(pair_);
  LocalShifts locals(pyramids_, kLastLevel, field, face, context_);
  double before = 0;
  for (int round = 0; round < kMotionRounds; ++round) {
    fit_row_motion(locals.measure({linear, &motion}), linear, pair_.face_width_px, context_, motion);
    if (!motion.seen || std::abs(motion.rms_px - before) < kMotionSettledPx) break;
    before = motion.rms_px;
  }
  return motion;
}

void RowAligner::apply(const EpipolarShift* linear, const RowMotion& motion) {
  if (linear != nullptr) applied_ = applied_.measured() ? sum_of(applied_, *linear) : *linear;
  if (motion.seen) {
    for (std::size_t k = 0; k < motion.shift_px.values.size(); ++k)
      motion_.shift_px.values[k] += motion.shift_px.values[k];
    motion_.seen = true;
    motion_.rms_px = std::hypot(motion_.rms_px, motion.rms_px);
  }
  shift_rows({applied_, &motion_}, pair_.right.grey, pyramids_.right.front().grey, context_);
  halve_levels(pyramids_.right, context_.pool);
}

double RowAligner::largest(const RowShift& shift) const {
  const Ellipse face = middle_of_face(pair_);
  double most = 0;
  for (int y = 0; y < pair_.height_px; y += kMotionStepPx)
    for (int x = 0; x < pair_.width_px; x += kMotionStepPx)
      if (face.holds(x, y)) most = std::max(most, std::abs(shift.at(x, y)));
  return most;
}

EpipolarShift RowAligner::measure_linear(const SurfaceField& field) const {
  const EpipolarShift rest =
      measure_epipolar_shift(pair_, pyramids_, field, EpipolarSearch::Refine, context_);
  if (!rest.measured()) return applied_.measured() ? applied_ : measured_;
  return applied_.measured() ? sum_of(applied_, rest) : rest;
}

}  // namespace relievo::pipeline
