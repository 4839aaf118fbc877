// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/outlier_filters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/reconstruct/neighbourhood.h"

namespace relievo::pipeline {
namespace {

constexpr int kMostRings = 8;
constexpr float kAlone = -1;
constexpr int kBands = 32;

// The k least of what is offered, by insertion.
struct Nearest {
  explicit Nearest(int most) : most_(most) {}
  void offer(float squared) {
    if (count_ == most_ && !(squared < least_[std::size_t(count_ - 1)])) return;
    int at = count_ < most_ ? count_++ : count_ - 1;
    for (; at > 0 && least_[std::size_t(at - 1)] > squared; --at)
      least_[std::size_t(at)] = least_[std::size_t(at - 1)];
    least_[std::size_t(at)] = squared;
  }
  bool full() const { return count_ == most_; }
  float mean_distance() const {
    if (count_ == 0) return kAlone;
    float sum = 0;
    for (int k = 0; k < count_; ++k) sum += std::sqrt(least_[std::size_t(k)]);
    return sum / float(count_);
  }

 private:
  int most_;
  int count_ = 0;
  std::array<float, StatisticalOutlierFilter::kMostNeighbours> least_{};
};

float mean_distance(const PointCloud& cloud, const Neighbourhood& near, std::uint32_t i, int column, int row,
                    int neighbours) {
  Nearest nearest(neighbours);
  const Vec3f& p = cloud.points[i].at_mm;
  const auto look = [&](int c, int r) {
    for (const std::uint32_t k : near.cell(c, r)) {
      if (k == i) continue;
      const Vec3f& q = cloud.points[k].at_mm;
      nearest.offer((q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y) + (q.z - p.z) * (q.z - p.z));
    }
  };
  look(column, row);
  for (int ring = 1; ring <= kMostRings && (ring <= near.reach() || !nearest.full()); ++ring)
    for (int s = -ring; s <= ring; ++s) {
      look(column + s, row - ring);
      look(column + s, row + ring);
      if (std::abs(s) == ring) continue;
      look(column - ring, row + s);
      look(column + ring, row + s);
    }
  return nearest.mean_distance();
}

}  // namespace

Result<void> StatisticalOutlierFilter::reject(PointCloud& cloud, StageContext& context) const {
  const Neighbourhood near(cloud, &context.scratch);
  std::pmr::vector<float> distance(cloud.points.size(), kAlone, &context.scratch);
  context.pool.for_each_band(near.rows(), kBands, [&](int begin, int end, int) {
    for (int r = begin; r < end && !context.stop(); ++r)
      for (int c = 0; c < near.columns(); ++c)
        for (const std::uint32_t i : near.cell(c, r))
          distance[i] = mean_distance(cloud, near, i, c, r, neighbours);
  });
  if (context.stop()) return Error{Errc::Cancelled, "the search for outliers was stopped"};
  double n = 0;
  double sum = 0;
  double squares = 0;
  for (const float d : distance) {
    if (d == kAlone) continue;
    n += 1;
    sum += double(d);
    squares += double(d) * double(d);
  }
  const double mean = sum / std::max(1.0, n);
  const double limit = mean + deviations * std::sqrt(std::max(0.0, squares / std::max(1.0, n) - mean * mean));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (distance[i] != kAlone && double(distance[i]) <= limit) cloud.points[kept++] = cloud.points[i];
  cloud.points.resize(kept);
  return {};
}

}  // namespace relievo::pipeline
