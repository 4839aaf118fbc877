// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/response/corner_response.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/match/image/plane_filters.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;

bool selectable_at(const RectifiedPair& pair, int x, int y) {
  const std::size_t k = pair.index(x, y);
  return pair.left.valid[k] != 0 && (pair.region.empty() || pair.region[k] != 0);
}

bool is_peak(const Plane<float>& response, int x, int y, int radius) {
  const float here = response.row(y)[x];
  const int left = std::max(0, x - radius);
  const int right = std::min(response.width - 1, x + radius);
  for (int j = std::max(0, y - radius); j <= std::min(response.height - 1, y + radius); ++j)
    for (int i = left; i <= right; ++i) {
      const float there = response.row(j)[i];
      const bool before = j < y || (j == y && i < x);
      if (before ? there >= here : there > here) return false;
    }
  return true;
}

bool stronger(const Candidate& a, const Candidate& b) {
  if (a.strength != b.strength) return a.strength > b.strength;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

using Candidates = std::pmr::vector<Candidate>;

Result<void> check_start(const RectifiedPair& pair, StageContext& context) {
  RELIEVO_TRY(check_pixels(pair));
  if (!pair.region.empty() && pair.region.size() != pair.left.grey.size())
    return invalid("the region is not the pair's");
  if (context.stop()) return stopped();
  return {};
}

Candidates peaks_of(const Plane<float>& response, float least, int radius, StageContext& context,
                    std::pmr::memory_resource* memory) {
  std::array<std::size_t, kBands> found{};
  const auto each_peak = [&](int begin, int end, auto&& take) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < response.width; ++x)
        if (response.row(y)[x] > least && is_peak(response, x, y, radius)) take(x, y);
  };
  context.pool.for_each_band(response.height, kBands, [&](int begin, int end, int band) {
    each_peak(begin, end, [&](int, int) { ++found[std::size_t(band)]; });
  });
  std::size_t count = 0;
  for (std::size_t& n : found) {
    const std::size_t first = count;
    count += n;
    n = first;
  }
  Candidates peaks(count, memory);
  context.pool.for_each_band(response.height, kBands, [&](int begin, int end, int band) {
    std::size_t next = found[std::size_t(band)];
    each_peak(begin, end, [&](int x, int y) { peaks[next++] = {x, y, response.row(y)[x]}; });
  });
  return peaks;
}

void choose_spread(Candidates& candidates, double min_distance, int max_points, Plane<float>& chosen,
                   Arena& scratch) {
  Arena::Mark mark(scratch);
  std::ranges::sort(candidates, stronger);
  // Two points of one cell would be nearer than the distance: a cell holds one.
  const double cell = std::max(1.0, min_distance / std::sqrt(2.0));
  const int reach = int(std::ceil(min_distance / cell));
  const auto index = [&](int v) { return int(double(v) / cell); };
  Plane<const Candidate*> taken(&scratch, index(chosen.width) + 1, index(chosen.height) + 1, nullptr);
  const auto is_free = [&](const Candidate& c) {
    for (int j = std::max(0, index(c.y) - reach); j <= std::min(taken.height - 1, index(c.y) + reach); ++j)
      for (int i = std::max(0, index(c.x) - reach); i <= std::min(taken.width - 1, index(c.x) + reach); ++i)
        if (const Candidate* other = taken.row(j)[i]; other != nullptr) {
          const double dx = other->x - c.x;
          const double dy = other->y - c.y;
          if (dx * dx + dy * dy < min_distance * min_distance) return false;
        }
    return true;
  };
  int count = 0;
  for (const Candidate& c : candidates) {
    if (count == max_points) break;
    if (!is_free(c)) continue;
    taken.row(index(c.y))[index(c.x)] = &c;
    chosen.row(c.y)[c.x] = c.strength;
    ++count;
  }
}

// Products of the gradient (Sobel's); 0 along the picture's edge.
void products(const std::pmr::vector<float>& grey, ThreadPool& pool, Plane<float>& xx, Plane<float>& xy,
              Plane<float>& yy) {
  pool.for_each(xx.height - 2, kBands, [&](int above) {
    const int y = above + 1;
    const float* here = grey.data() + std::ptrdiff_t(y) * xx.width;
    for (int x = 1; x + 1 < xx.width; ++x) {
      const float *up = here - xx.width, *low = here + xx.width;
      const float left = up[x - 1] + 2 * here[x - 1] + low[x - 1];
      const float right = up[x + 1] + 2 * here[x + 1] + low[x + 1];
      const float top = up[x - 1] + 2 * up[x] + up[x + 1];
      const float bottom = low[x - 1] + 2 * low[x] + low[x + 1];
      const Vec2f g{0.125F * (right - left), 0.125F * (bottom - top)};
      xx.row(y)[x] = g.x * g.x, xy.row(y)[x] = g.x * g.y, yy.row(y)[x] = g.y * g.y;
    }
  });
}

}  // namespace

Selectable::Selectable(const RectifiedPair& pair, std::pmr::memory_resource* memory)
    : pair_(pair), valid_above_(memory, pair.width_px + 1, pair.height_px + 1, 0) {
  for (int y = 0; y < pair.height_px; ++y) {
    std::int32_t in_row = 0;
    for (int x = 0; x < pair.width_px; ++x) {
      in_row += pair.left.valid[pair.index(x, y)] != 0 ? 1 : 0;
      valid_above_.row(y + 1)[x + 1] = valid_above_.row(y)[x + 1] + in_row;
      count_ += selectable_at(pair, x, y) ? 1 : 0;
    }
  }
}

bool Selectable::valid_block(int x, int y, int side) const {
  if (x < 0 || y < 0 || x + side > pair_.width_px || y + side > pair_.height_px) return false;
  const std::int32_t* top = valid_above_.row(y) + x;
  const std::int32_t* bottom = valid_above_.row(y + side) + x;
  return bottom[side] - bottom[0] - top[side] + top[0] == side * side;
}

bool Selectable::operator()(int x, int y, int margin) const {
  return valid_block(x - margin, y - margin, 2 * margin + 1) && selectable_at(pair_, x, y);
}

Result<Selectable> selectable_of(const RectifiedPair& pair, StageContext& context) {
  RELIEVO_TRY(check_start(pair, context));
  Selectable selectable(pair, &context.scratch);
  if (selectable.count() == 0) return Error{Errc::NoFace, "the face region is empty: nothing to match"};
  return selectable;
}

Result<void> mark_peaks(Plane<float>& response, const PeakChoice& choice, Plane<float>& chosen,
                        StageContext& context) {
  const float greatest = *std::ranges::max_element(response.values);
  if (!(greatest > 0)) return {};
  for (float& r : response.values) r /= greatest;
  Arena::Mark mark(context.scratch);
  Candidates peaks = peaks_of(response, float(choice.least), choice.radius_px, context, &context.scratch);
  if (context.stop()) return stopped();
  choose_spread(peaks, choice.distance_px, choice.max_points, chosen, context.scratch);
  if (context.stop()) return stopped();
  return {};
}

Result<Keypoints> keypoints_of(const Plane<float>& chosen, int max_points, StageContext& context) {
  Arena::Mark mark(context.scratch);
  const auto count = std::size_t(std::ranges::count_if(chosen.values, [](float v) { return v > 0; }));
  if (count == 0)
    return Error{
        Errc::TooFewMatches,
        "no place of the left view stands out: lower the selector's quality, or is the picture dark or out of focus?"};
  Candidates all(&context.scratch);
  all.reserve(count);
  for (int y = 0; y < chosen.height; ++y)
    for (int x = 0; x < chosen.width; ++x)
      if (chosen.row(y)[x] > 0) all.push_back({x, y, chosen.row(y)[x]});
  const std::size_t kept = std::min(count, std::size_t(max_points));
  if (kept < count) {
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(kept), all.end(), stronger);
    all.resize(kept);
    std::ranges::sort(
        all, [](const Candidate& a, const Candidate& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  }
  Keypoints keypoints(&context.output);
  keypoints.points.reserve(kept);
  for (const Candidate& c : all) keypoints.points.push_back({{float(c.x), float(c.y)}, c.strength});
  return keypoints;
}

Result<Keypoints> peak_keypoints(Plane<float>& response, const PeakChoice& choice, StageContext& context) {
  Plane<float> chosen(&context.scratch, response.width, response.height);
  RELIEVO_TRY(mark_peaks(response, choice, chosen, context));
  return keypoints_of(chosen, choice.max_points, context);
}

Result<Keypoints> lattice_keypoints(const RectifiedPair& pair, int step_px, const LatticeArea& area,
                                    StageContext& context) {
  RELIEVO_TRY(check_start(pair, context));
  const auto each_node = [&](auto&& take) {
    for (int y = area.top; y <= area.bottom; y += step_px)
      for (int x = area.left; x <= area.right; x += step_px)
        if (selectable_at(pair, x, y)) take(x, y);
  };
  std::size_t count = 0;
  each_node([&](int, int) { ++count; });
  if (count == 0) return Error{Errc::NoFace, "the face region is empty: nothing to match"};
  Keypoints keypoints(&context.output);
  keypoints.lattice_step_px = step_px;
  keypoints.points.reserve(count);
  each_node([&](int x, int y) { keypoints.points.push_back({{float(x), float(y)}, 1}); });
  return keypoints;
}

SalientTracks::SalientTracks(const std::pmr::vector<float>& grey, int width_px, int height_px, int scales,
                             std::pmr::memory_resource* memory)
    : means_(memory) {
  means_.reserve(std::size_t(scales) + 1);
  means_.emplace_back(memory, width_px, height_px);
  std::ranges::copy(grey, means_[0].values.begin());
  for (int s = 0; s < scales && means_.back().width >= 2 && means_.back().height >= 2; ++s) {
    const Plane<float>& from = means_.back();
    Plane<float> to(memory, from.width / 2, from.height / 2);
    for (int y = 0; y < to.height; ++y)
      for (int x = 0; x < to.width; ++x) {
        const float* upper = from.row(2 * y) + 2 * x;
        const float* lower = from.row(2 * y + 1) + 2 * x;
        to.row(y)[x] = 0.25F * (upper[0] + upper[1] + lower[0] + lower[1]);
      }
    means_.push_back(std::move(to));
  }
}

float SalientTracks::magnitude(int scale, int orientation, int column, int row) const {
  const Plane<float>& finer = means_[std::size_t(scale) - 1];
  const float* upper = finer.row(2 * row) + 2 * column;
  const float* lower = finer.row(2 * row + 1) + 2 * column;
  const float left = upper[0] + lower[0], right = upper[1] + lower[1];
  const float difference = orientation == 0   ? right - left
                           : orientation == 1 ? lower[0] + lower[1] - upper[0] - upper[1]
                                              : upper[0] + lower[1] - upper[1] - lower[0];
  // Means of 4^(scale-1) pixels; half a level keeps the energy.
  return std::ldexp(std::abs(difference), scale - 2);
}

Candidate SalientTracks::follow(int scale, int orientation, int column, int row) const {
  float saliency = magnitude(scale, orientation, column, row);
  for (; scale > 1; --scale) {
    float greatest = 0;
    const int first_column = 2 * column;
    const int first_row = 2 * row;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        if (const float m = magnitude(scale - 1, orientation, first_column + i, first_row + j);
            m > greatest) {
          greatest = m;
          column = first_column + i;
          row = first_row + j;
        }
    if (!(greatest > 0)) break;
    saliency += greatest;
  }
  Candidate end = end_of(scale, column, row);
  end.strength = saliency;
  return end;
}

// Of the pixels under a coefficient the one with the greatest gradient.
Candidate SalientTracks::end_of(int scale, int column, int row) const {
  const Plane<float>& picture = means_[0];
  const int side = 1 << scale;
  Candidate best{side * column, side * row, -1};
  for (int y = side * row; y < side * (row + 1); ++y)
    for (int x = side * column; x < side * (column + 1); ++x) {
      const float dx =
          picture.row(y)[std::min(x + 1, picture.width - 1)] - picture.row(y)[std::max(x - 1, 0)];
      const float dy =
          picture.row(std::min(y + 1, picture.height - 1))[x] - picture.row(std::max(y - 1, 0))[x];
      if (const float gradient = dx * dx + dy * dy; gradient > best.strength) best = {x, y, gradient};
    }
  return best;
}

FastHessian::FastHessian(const std::pmr::vector<float>& grey, int width_px, int height_px,
                         std::pmr::memory_resource* memory)
    : above_(memory, width_px + 1, height_px + 1, 0.0) {
  for (int y = 0; y < height_px; ++y) {
    const float* from = grey.data() + std::ptrdiff_t(y) * width_px;
    double in_row = 0;
    for (int x = 0; x < width_px; ++x) {
      in_row += double(from[x]);
      above_.row(y + 1)[x + 1] = above_.row(y)[x + 1] + in_row;
    }
  }
}

double FastHessian::sum(int left, int top, int width, int height) const {
  const double* upper = above_.row(top) + left;
  const double* lower = above_.row(top + height) + left;
  return lower[width] - lower[0] - upper[width] + upper[0];
}

float FastHessian::determinant(int x, int y, int size) const {
  const int lobe = size / 3;
  const int half = size / 2;
  const int broad = 2 * lobe - 1;
  // Three lobes, 1 -2 1: the whole minus three times the middle.
  const double xx =
      sum(x - half, y - lobe + 1, size, broad) - 3 * sum(x - lobe / 2, y - lobe + 1, lobe, broad);
  const double yy =
      sum(x - lobe + 1, y - half, broad, size) - 3 * sum(x - lobe + 1, y - lobe / 2, broad, lobe);
  const double xy = sum(x + 1, y - lobe, lobe, lobe) + sum(x - lobe, y + 1, lobe, lobe) -
                    sum(x - lobe, y - lobe, lobe, lobe) - sum(x + 1, y + 1, lobe, lobe);
  const double area = double(size) * double(size);
  return float((xx * yy - 0.81 * xy * xy) / (area * area));
}

float smaller_eigenvalue(float xx, float xy, float yy, float) {
  const float half = 0.5F * (xx - yy);
  return 0.5F * (xx + yy) - std::sqrt(half * half + xy * xy);
}

float harris_measure(float xx, float xy, float yy, float sensitivity) {
  const float trace = xx + yy;
  return xx * yy - xy * xy - sensitivity * trace * trace;
}

Result<void> corner_response(const std::pmr::vector<float>& grey, const Selectable& selectable,
                             const ResponseWindow& window, CornerMeasure measure, float parameter,
                             StageContext& context, Plane<float>& response) {
  std::ranges::fill(response.values, 0.0F);
  if (response.width < 3 || response.height < 3) return {};
  Arena::Mark mark(context.scratch);
  Plane<float> xx(&context.scratch, response.width, response.height);
  Plane<float> xy(&context.scratch, response.width, response.height);
  Plane<float> yy(&context.scratch, response.width, response.height);
  Plane<float> across(&context.scratch, response.width, response.height);
  products(grey, context.pool, xx, xy, yy);
  for (Plane<float>* plane : {&xx, &xy, &yy})
    for (int pass = 0; pass < window.passes; ++pass) {
      if (context.stop()) return stopped();
      box_sum(*plane, window.radius_px, context.pool, across, *plane);
    }
  const float side = float(2 * window.radius_px + 1);
  const float mean = 1 / std::pow(side, float(2 * window.passes));
  const int margin = window.reach_px();
  context.pool.for_each(response.height, kBands, [&](int y) {
    for (int x = 0; x < response.width; ++x)
      if (selectable(x, y, margin))
        response.row(y)[x] =
            std::max(0.0F, measure(mean * xx.row(y)[x], mean * xy.row(y)[x], mean * yy.row(y)[x], parameter));
  });
  if (context.stop()) return stopped();
  return {};
}

}  // namespace relievo::pipeline
