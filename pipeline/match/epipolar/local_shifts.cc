// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/local_shifts.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "pipeline/base/solving.h"
#include "pipeline/match/epipolar/column_sample.h"
#include "pipeline/match/image/box_filter.h"

namespace relievo::pipeline {
namespace {

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

}  // namespace

FaceEllipse::FaceEllipse(const RectifiedPair& pair)
    : x_(pair.face_centre_px.x),
      y_(pair.face_centre_px.y),
      half_width_(kHalfWidth * pair.face_width_px),
      half_height_(kHalfHeight * pair.face_width_px) {}

bool FaceEllipse::holds(double x_px, double y_px) const {
  if (half_width_ <= 0) return true;
  const double u = (x_px - x_) / half_width_, v = (y_px - y_) / half_height_;
  return u * u + v * v < 1;
}

LocalShifts::LocalShifts(const Pyramids& pyramids, int level, const SurfaceField& field,
                         const FaceEllipse& face, StageContext& context)
    : left_(pyramids.left[static_cast<std::size_t>(level)]),
      right_(pyramids.right[static_cast<std::size_t>(level)]),
      field_(field),
      face_(face),
      context_(context),
      level_(level),
      stride_(std::max(1, (1 << level) / field.step_px)),
      left_detail_(&context.scratch, left_.grey.width, left_.grey.height),
      right_detail_(&context.scratch, right_.grey.width, right_.grey.height),
      patches_(&context.scratch, patches_over(field.domain.width, stride_),
               patches_over(field.domain.height, stride_)),
      locals_(patches_.values.size(), &context.scratch) {
  high_pass(left_.grey, context, left_detail_);
  high_pass(right_.grey, context, right_detail_);
}

void LocalShifts::add_node(const RowShift& from, int x, int y, double disparity_px, Patch& patch) const {
  const double scale = 1 << level_;
  const double xr = x - disparity_px / scale;
  const double yr = y + from.at(xr * scale, y * scale) / scale;
  const int ix = static_cast<int>(std::floor(xr));
  const int iy = static_cast<int>(std::floor(yr));
  constexpr int kMargin = kRadius + kColumnReach;
  const Plane<float>& l = left_detail_;
  const Plane<float>& r = right_detail_;
  if (ix < kMargin || iy < kMargin || ix + kMargin >= r.width || iy + kMargin >= r.height || x < kMargin ||
      y < kMargin || x + kMargin >= l.width || y + kMargin >= l.height)
    return;
  if (left_.grey.row(y)[x] > kSaturated || right_.grey.row(iy)[ix] > kSaturated) return;
  const auto tx = static_cast<float>(xr - ix);
  const ColumnWeights column(static_cast<float>(yr - iy));
  const float* at = r.row(iy) + ix;
  const double seen =
      static_cast<double>((1 - tx) * column.sample(at, r.width) + tx * column.sample(at + 1, r.width));
  const auto here = static_cast<double>(l.row(y)[x]);
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

void LocalShifts::gather(const RowShift& from) {
  const int reach = kPatchPx * stride_;
  context_.pool.for_each_band(patches_.height, kBands, [&](int begin, int end, int) {
    for (int q = begin; q < end; ++q)
      for (int p = 0; p < patches_.width; ++p) {
        Patch& patch = patches_.row(q)[p] = {};
        const int j_end = std::min(field_.domain.height, (q + 1) * reach);
        const int i_end = std::min(field_.domain.width, (p + 1) * reach);
        for (int j = q * reach; j < j_end; j += stride_)
          for (int i = p * reach; i < i_end; i += stride_)
            if (field_.domain.row(j)[i] != 0 && face_.holds(i * field_.step_px, j * field_.step_px))
              add_node(from, i / stride_, j / stride_, static_cast<double>(field_.disparity_px.row(j)[i]),
                       patch);
      }
  });
}

std::span<const LocalShift> LocalShifts::measure(const RowShift& from) {
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

}  // namespace relievo::pipeline
