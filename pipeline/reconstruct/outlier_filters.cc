// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/outlier_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <numbers>
#include <span>

#include "pipeline/base/cells.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 32;

constexpr float kLargestPixel = 100'000;
constexpr double kPointsPerBucket = 3;  // nine then hold about as many as a lattice's neighbourhood

bool usable(const CloudPoint& p) {
  return std::isfinite(p.at_mm.x) && std::isfinite(p.at_mm.y) && std::isfinite(p.at_mm.z) && p.at_mm.z > 0 &&
         std::abs(p.left_px.x) < kLargestPixel && std::abs(p.left_px.y) < kLargestPixel;
}

// Neighbourhood: who is near whom in the left view, for clouds on a lattice and for scattered ones.
// Every cell holds the points of one lattice node (at most one), or of one bucket (a few).
struct Neighbourhood {
  // Throws std::bad_alloc. Points whose coordinates are not finite get no cell.
  Neighbourhood(const PointCloud& cloud, std::pmr::memory_resource* memory)
      : on_lattice(cloud.lattice_step_px > 0), cells(memory) {
    float left = kLargestPixel;
    float top = kLargestPixel;
    float right = -kLargestPixel;
    float bottom = -kLargestPixel;
    std::size_t count = 0;
    for (const CloudPoint& p : cloud.points) {
      if (!usable(p)) continue;
      ++count;
      left = std::min(left, p.left_px.x);
      right = std::max(right, p.left_px.x);
      top = std::min(top, p.left_px.y);
      bottom = std::max(bottom, p.left_px.y);
    }
    if (count == 0) return;
    const double area = double(right - left + 1) * double(bottom - top + 1);
    const double step = on_lattice ? cloud.lattice_step_px
                                   : std::max(1e-3, std::sqrt(area * kPointsPerBucket / double(count)));
    const auto cell_of = [step](float from, float at) { return int(std::lround(double(at - from) / step)); };
    cells.fill(cell_of(left, right) + 1, cell_of(top, bottom) + 1, [&](auto&& add) {
      for (std::uint32_t i = 0; i < cloud.points.size(); ++i)
        if (const CloudPoint& p = cloud.points[i]; usable(p))
          add(cell_of(left, p.left_px.x), cell_of(top, p.left_px.y), i);
    });
  }

  // How far around a point its neighbours are looked for, in cells.
  int reach() const { return on_lattice ? 2 : 1; }
  // judge(point, column, row), on the pool. False once stopped.
  template <typename Judge>
  bool for_each_point(StageContext& context, const Judge& judge) const {
    context.pool.for_each(cells.rows(), kBands, [&](int r) {
      if (context.stop()) return;
      for (int c = 0; c < cells.columns(); ++c)
        for (const std::uint32_t i : cells.at(c, r)) judge(i, c, r);
    });
    return !context.stop();
  }

  bool on_lattice;
  Cells cells;
};

constexpr int kMostRings = 8;
constexpr float kAlone = -1;

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
  const auto done = [&](int ring) { return ring > kMostRings || (ring > near.reach() && nearest.full()); };
  near.cells.by_rings(column, row, done, [&](std::uint32_t k) {
    if (k != i) nearest.offer(squared_distance(cloud.points[k].at_mm, p));
  });
  return nearest.mean_distance();
}

struct Offset {
  float u, v, depth;
};  // from the centre, in its RayFrame

// Depth along the line of sight of the centre, and across it: the frame for support and planes.
struct RayFrame {
  explicit RayFrame(const Vec3f& centre) : at(centre) {
    const float l = length(at);
    along = {at.x / l, at.y / l, at.z / l};
    const float flat = std::sqrt(along.x * along.x + along.z * along.z);
    across = {along.z / flat, 0, -along.x / flat};
    down = {along.y * across.z, along.z * across.x - along.x * across.z, -along.y * across.x};
  }
  Offset operator()(const Vec3f& place) const {
    const Vec3f d = minus(place, at);
    return {dot(d, across), dot(d, down), dot(d, along)};
  }
  Vec3f at, along, across, down;
};

class Filter {
 public:
  Filter(const PointCloud& cloud, const LocalOutlierFilter& options, Arena& scratch)
      : cloud_(cloud), options_(options), scratch_(&scratch) {}

  // Points without a cell were not finite; they are not kept.
  bool judge(StageContext& context) {
    return near_.for_each_point(
        context, [&](std::uint32_t i, int column, int row) { kept_[i] = belongs(i, column, row) ? 1 : 0; });
  }

  void drop_islands(Arena& scratch) {
    reached_.assign(points_.size(), std::uint8_t{0});
    stack_.reserve(points_.size());
    std::pmr::vector<std::uint64_t> at(points_.size(), 0U, &scratch);  // row << 32 | column
    for (int r = 0; r < near_.cells.rows(); ++r)
      for (int c = 0; c < near_.cells.columns(); ++c)
        for (const std::uint32_t i : near_.cells.at(c, r)) at[i] = std::uint64_t(r) << 32 | std::uint64_t(c);
    const std::size_t least = std::size_t(options_.min_island * double(points_.size()));
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (kept_[i] == 0 || reached_[i] != 0) continue;
      flood(i, at);
      if (stack_.size() >= least) continue;
      for (const std::uint32_t k : stack_) kept_[k] = 0;
    }
  }

  bool keeps(std::size_t i) const { return kept_[i] != 0; }

 private:
  bool supports(const Offset& o, float sigma) const {
    return std::abs(o.depth) <= max_slope_ * std::sqrt(o.u * o.u + o.v * o.v) + 2 * sigma;
  }

  // Supported by its neighbours, and no spike off their plane.
  bool belongs(std::uint32_t i, int column, int row) const {
    const CloudPoint& p = points_[i];
    const RayFrame ray(p.at_mm);
    int places = 0;
    int support = 0;
    constexpr int kMostKept = 64;  // enough for a plane
    Offset near[kMostKept];
    const int reach = near_.reach();
    for (int r = row - reach; r <= row + reach; ++r)
      for (int c = column - reach; c <= column + reach; ++c)
        for (const std::uint32_t k : near_.cells.at(c, r)) {
          if (k == i) continue;
          ++places;
          const Offset o = ray(points_[k].at_mm);
          if (!supports(o, std::max(p.sigma_mm, points_[k].sigma_mm))) continue;
          if (support < kMostKept) near[support] = o;
          ++support;
        }
    // On a lattice an empty place is evidence against a point; in a scattered cloud it means nothing.
    const double wanted = options_.min_support * (near_.on_lattice ? 24 : std::max(places, 6));
    return support >= wanted && !(options_.spike_sigmas > 0 &&
                                  off_plane({near, std::size_t(std::min(support, kMostKept))}, p.sigma_mm));
  }

  struct Plane {
    float slope_u = 0, slope_v = 0, base = 0, scatter = 0;
    bool known = false;
  };

  // Least-squares plane of the neighbours within `limit` of `first`; base is its depth at the point.
  static Plane fit(std::span<const Offset> near, const Plane& first, float limit) {
    float n = 0, u = 0, v = 0, d = 0, uu = 0, uv = 0, vv = 0, ud = 0, vd = 0, dd = 0;
    for (const Offset& o : near) {
      if (std::abs(o.depth - first.base - first.slope_u * o.u - first.slope_v * o.v) > limit) continue;
      n += 1;
      u += o.u;
      v += o.v;
      d += o.depth;
      uu += o.u * o.u;
      uv += o.u * o.v;
      vv += o.v * o.v;
      ud += o.u * o.depth;
      vd += o.v * o.depth;
      dd += o.depth * o.depth;
    }
    if (n < 6) return {};
    uu -= u * u / n;
    uv -= u * v / n;
    vv -= v * v / n;
    ud -= u * d / n;
    vd -= v * d / n;
    dd -= d * d / n;
    const float det = uu * vv - uv * uv;
    if (!(det > 1e-6F * uu * vv)) return {};
    Plane plane;
    plane.slope_u = (ud * vv - vd * uv) / det;
    plane.slope_v = (vd * uu - ud * uv) / det;
    plane.base = (d - plane.slope_u * u - plane.slope_v * v) / n;
    plane.scatter = std::sqrt(std::max(0.0F, dd - plane.slope_u * ud - plane.slope_v * vd) / n);
    plane.known = true;
    return plane;
  }

  // The point itself has no vote. A second fit without the worst neighbours, where they scatter more
  // than they should: another spike next to this one must not hide it.
  bool off_plane(std::span<const Offset> near, float sigma) const {
    Plane plane = fit(near, {}, std::numeric_limits<float>::infinity());
    if (!plane.known) return false;
    if (plane.scatter > 1.5F * sigma)
      if (const Plane again = fit(near, plane, 1.5F * plane.scatter); again.known) plane = again;
    return std::abs(plane.base) > float(options_.spike_sigmas) * std::max(plane.scatter, sigma);
  }

  void flood(std::uint32_t seed, const std::pmr::vector<std::uint64_t>& at) {
    stack_.assign(1, seed);
    reached_[seed] = 1;
    for (std::size_t next = 0; next < stack_.size(); ++next) {
      const std::uint32_t i = stack_[next];
      const RayFrame ray(points_[i].at_mm);
      const int column = int(at[i] & 0xFFFFFFFFU);
      const int row = int(at[i] >> 32);
      for (int r = row - 1; r <= row + 1; ++r)
        for (int c = column - 1; c <= column + 1; ++c)
          for (const std::uint32_t k : near_.cells.at(c, r)) {
            if (kept_[k] == 0 || reached_[k] != 0 ||
                !supports(ray(points_[k].at_mm), std::max(points_[i].sigma_mm, points_[k].sigma_mm)))
              continue;
            reached_[k] = 1;
            stack_.push_back(k);
          }
    }
  }

  const PointCloud& cloud_;
  const LocalOutlierFilter& options_;
  std::pmr::memory_resource* scratch_;
  std::span<const CloudPoint> points_ = cloud_.points;
  Neighbourhood near_{cloud_, scratch_};
  float max_slope_{float(std::tan(options_.max_incidence_deg * std::numbers::pi / 180))};
  std::pmr::vector<std::uint8_t> kept_{points_.size(), std::uint8_t{0}, scratch_}, reached_{scratch_};
  std::pmr::vector<std::uint32_t> stack_{scratch_};
};

}  // namespace

Result<void> StatisticalOutlierFilter::reject(PointCloud& cloud, StageContext& context) const {
  const Neighbourhood near(cloud, &context.scratch);
  std::pmr::vector<float> distance(cloud.points.size(), kAlone, &context.scratch);
  if (!near.for_each_point(context, [&](std::uint32_t i, int column, int row) {
        distance[i] = mean_distance(cloud, near, i, column, row, neighbours);
      }))
    return stopped();
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

Result<void> LocalOutlierFilter::reject(PointCloud& cloud, StageContext& context) const {
  if (context.stop()) return stopped();
  Filter filter(cloud, *this, context.scratch);
  if (!filter.judge(context)) return stopped();
  filter.drop_islands(context.scratch);
  if (context.stop()) return stopped();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (filter.keeps(i)) cloud.points[kept++] = cloud.points[i];
  cloud.points.resize(kept);
  return {};
}

}  // namespace relievo::pipeline
