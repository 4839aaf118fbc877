// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/pasted_head.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace relievo::test {
namespace {

namespace sim = hal::sim;
using sim::Vec3;

constexpr double kSidesDeg = 42;
constexpr double kAcrossMm = 420, kStepMm = 1.1;  // of a photograph, where it meets the face
constexpr double kFarMm = 700, kTornMm = 14;      // no surface runs from one point to the next over more
constexpr double kSeamMm = 38;                    // from the middle of the face: there the photographs meet

}  // namespace

PastedHead::PastedHead(const std::shared_ptr<const sim::HeadModel>& head, ThreadPool& pool) {
  const sim::HeadPose pose;
  const auto scene = sim::make_head_scene(head, pose, pool);
  for (const double side : {-kSidesDeg, 0.0, kSidesDeg}) photograph(*scene, pose, side, pool);
}

// Parallel rays from that side of the head.
void PastedHead::photograph(const sim::Scene& scene, const sim::HeadPose& pose, double side_deg,
                            ThreadPool& pool) {
  const int n = static_cast<int>(kAcrossMm / kStepMm);
  const auto count = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  const double a = side_deg * std::numbers::pi / 180;
  const sim::Mat3 world_from_head = pose.world_from_head();
  const Vec3 out{std::sin(a), 0, std::cos(a)}, right{std::cos(a), 0, -std::sin(a)}, up{0, 1, 0};
  std::vector<Corner> grid(count);
  std::vector<double> far(count);
  const Vec3 direction = world_from_head * -out;
  pool.for_each_band(n, 32, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < n; ++x) {
        const auto i = static_cast<std::size_t>(y * n + x);
        const Vec3 from = out * kFarMm + right * ((x - n / 2) * kStepMm) + up * ((y - n / 2) * kStepMm - 40);
        const sim::RayHit hit = scene.look(pose.origin_mm() + world_from_head * from, direction);
        far[i] = hit.body < 0 ? -1 : hit.distance_mm;
        grid[i] = {from - out * hit.distance_mm, hit.light};
      }
  });
  const auto first = static_cast<std::uint32_t>(corners_.size());
  corners_.insert(corners_.end(), grid.begin(), grid.end());
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
    if (far[i] < 0 || far[j] < 0 || far[k] < 0) return;
    if (std::max({far[i], far[j], far[k]}) - std::min({far[i], far[j], far[k]}) > kTornMm) return;
    const double x = grid[i].at.x * (side_deg < 0 ? -1 : 1);
    if (side_deg == 0 ? std::abs(x) > kSeamMm + kStepMm : x < kSeamMm - kStepMm) return;
    triangles_.push_back({first + static_cast<std::uint32_t>(i), first + static_cast<std::uint32_t>(j),
                          first + static_cast<std::uint32_t>(k)});
  };
  const auto w = static_cast<std::size_t>(n);
  for (std::size_t y = 0; y + 1 < w; ++y)
    for (std::size_t x = 0; x + 1 < w; ++x) {
      const std::size_t i = y * w + x;
      add(i, i + 1, i + w);
      add(i + w + 1, i + w, i + 1);
    }
}

void PastedHead::draw(const sim::HeadPose& pose, const sim::SimView& view, sim::LightPicture& picture) const {
  struct Seen {
    double x, y, depth;
  };
  const sim::Mat3 turn = pose.world_from_head();
  const Vec3 origin = pose.origin_mm();
  std::vector<Seen> seen(corners_.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec3 at = origin + turn * corners_[i].at;
    const double depth = view.depth_mm(at);
    const sim::Pixel px = depth > 50 ? view.project(at) : sim::Pixel{-9, -9};
    seen[i] = {px.x, px.y, depth};
  }
  std::vector<double> nearest(picture.rgb.size() / 3, std::numeric_limits<double>::max());
  for (const auto& t : triangles_) {
    const Seen &a = seen[t[0]], &b = seen[t[1]], &c = seen[t[2]];
    if (std::min({a.depth, b.depth, c.depth}) <= 50) continue;
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(area) < 1e-9) continue;
    const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x})))),
              x1 = std::min(view.width_px - 1, static_cast<int>(std::max({a.x, b.x, c.x}))),
              y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y})))),
              y1 = std::min(view.height_px - 1, static_cast<int>(std::max({a.y, b.y, c.y})));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area,
                     v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area, w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        const auto i = static_cast<std::size_t>(y * view.width_px + x);
        const double depth = u * a.depth + v * b.depth + w * c.depth;
        if (depth >= nearest[i]) continue;
        nearest[i] = depth;
        const Vec3 light = corners_[t[0]].light * u + corners_[t[1]].light * v + corners_[t[2]].light * w;
        picture.rgb[3 * i] = static_cast<float>(light.x);
        picture.rgb[3 * i + 1] = static_cast<float>(light.y);
        picture.rgb[3 * i + 2] = static_cast<float>(light.z);
      }
  }
}

}  // namespace relievo::test
