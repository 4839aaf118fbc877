// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/response/keypoint_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr std::size_t kBands = 16;

bool selectable_at(const RectifiedPair& pair, int x, int y) {
  const std::size_t k = std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x);
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
    return Error{Errc::InvalidInput, "the region is not the pair's"};
  if (context.stop()) return selection_stopped();
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

}  // namespace

Selectable::Selectable(const RectifiedPair& pair, std::pmr::memory_resource* memory)
    : pair_(pair), valid_above_(memory, pair.width_px + 1, pair.height_px + 1, 0) {
  for (int y = 0; y < pair.height_px; ++y) {
    std::int32_t in_row = 0;
    for (int x = 0; x < pair.width_px; ++x) {
      in_row += pair.left.valid[std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x)] != 0 ? 1 : 0;
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

Error selection_stopped() { return {Errc::Cancelled, "the choice of keypoints was stopped"}; }

Result<Selectable> selectable_of(const RectifiedPair& pair, StageContext& context) {
  RELIEVO_TRY(check_start(pair, context));
  Selectable selectable(pair, &context.scratch);
  if (selectable.count() == 0) return Error{Errc::NoFace, "the face region is empty: nothing to match"};
  return selectable;
}

bool mark_peaks(Plane<float>& response, const PeakChoice& choice, Plane<float>& chosen,
                StageContext& context) {
  const float greatest = *std::ranges::max_element(response.values);
  if (!(greatest > 0)) return true;
  for (float& r : response.values) r /= greatest;
  Arena::Mark mark(context.scratch);
  Candidates peaks = peaks_of(response, float(choice.least), choice.radius_px, context, &context.scratch);
  if (context.stop()) return false;
  choose_spread(peaks, choice.distance_px, choice.max_points, chosen, context.scratch);
  return !context.stop();
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
  if (!mark_peaks(response, choice, chosen, context)) return selection_stopped();
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

}  // namespace relievo::pipeline
