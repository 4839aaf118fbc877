// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/chain/chain_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "firmware/measure/measurement.h"

namespace relievo::bench {
namespace {

namespace measure = firmware::measure;

constexpr double kReachMm = 20;

template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(double{a[k]} - double{b[k]}));
  return largest;
}

template <typename T>
using ByPixel = std::map<std::pair<float, float>, const T*>;

ByPixel<RecordedMatch> accepted(const ChainRecord& record) {
  ByPixel<RecordedMatch> by_pixel;
  for (const RecordedMatch& m : record.matches)
    if (m.rejected_by == 0) by_pixel.emplace(std::pair(m.x_px, m.y_px), &m);
  return by_pixel;
}

ByPixel<pipeline::CloudPoint> points(const ChainRecord& record) {
  ByPixel<pipeline::CloudPoint> by_pixel;
  for (const pipeline::CloudPoint& p : record.points)
    by_pixel.emplace(std::pair(p.left_px.x, p.left_px.y), &p);
  return by_pixel;
}

// Calls visit for each pair at the same pixel; returns {pairs, alone in either}.
template <typename T, typename Visit>
std::pair<std::size_t, std::size_t> pair_up(const ByPixel<T>& a, const ByPixel<T>& b, Visit visit) {
  std::size_t both = 0;
  for (const auto& [pixel, one] : a)
    if (const auto other = b.find(pixel); other != b.end()) ++both, visit(*one, *other->second);
  return {both, a.size() + b.size() - 2 * both};
}

std::vector<double> distances(const ChainRecord& surface, const ChainRecord& from) {
  std::vector<double> sizes;
  if (surface.triangles.empty()) return sizes;
  const measure::Surface triangles{surface.vertices_mm, surface.triangles};
  const measure::TriangleGrid grid(triangles);
  for (const pipeline::Vec3f& v : from.vertices_mm) {
    const auto nearest = grid.nearest(pipeline::wide(v), kReachMm);
    sizes.push_back(nearest ? nearest->distance_mm : kReachMm);
  }
  return sizes;
}

double colour_share(const ChainRecord& a, const ChainRecord& b) {
  if (a.rgb.size() != b.rgb.size() || a.rgb.empty()) return 1;
  std::size_t other = 0;
  for (std::size_t k = 0; k < a.rgb.size(); ++k) other += a.rgb[k] != b.rgb[k] ? 1 : 0;
  return static_cast<double>(other) / static_cast<double>(a.rgb.size());
}

bool identical(const ChainRecord& a, const ChainRecord& b) {
  return same(a.left_grey, b.left_grey) && same(a.right_grey, b.right_grey) && same(a.matches, b.matches) &&
         same(a.points, b.points) && same(a.vertices_mm, b.vertices_mm) && same(a.triangles, b.triangles) &&
         same(a.rgb, b.rgb);
}

std::string line(const char* what, const Spread& s, const char* unit) {
  char text[160];
  std::snprintf(text, sizeof text, "%s: median %.2g %s, 99.9 %% within %.2g, largest %.2g\n", what, s.median,
                unit, s.most_of_all, s.largest);
  return text;
}

}  // namespace

Spread spread_of(std::vector<double> sizes) {
  if (sizes.empty()) return {};
  std::sort(sizes.begin(), sizes.end());
  const auto at = [&sizes](double share) {
    return sizes[static_cast<std::size_t>(share * static_cast<double>(sizes.size() - 1))];
  };
  return {at(0.5), at(0.999), sizes.back()};
}

std::string ChainDifference::text() const {
  if (identical) return "identical in every byte, from the rectified pictures to the texture\n";
  char text[320];
  std::snprintf(text, sizeof text,
                "rectified grey: largest difference %.2g of 255\n%zu matches accepted by both, %zu by one "
                "alone\n%zu points in both, %zu in one alone\n",
                grey_levels, matches, matches_alone, points, points_alone);
  std::string all = text;
  all +=
      line("disparity", disparity_px, "px") + line("disparity in its own sigmas", disparity_sigmas, "sigma");
  all += line("points", point_mm, "mm") + line("points in their own sigmas", point_sigmas, "sigma") +
         line("surface", surface_mm, "mm");
  std::snprintf(text, sizeof text, "texture: %.3g %% of the bytes differ\n", 100 * colour_share);
  return all + text;
}

ChainDifference between(const ChainRecord& a, const ChainRecord& b) {
  ChainDifference d;
  d.identical = identical(a, b);
  d.grey_levels =
      std::max(largest_difference(a.left_grey, b.left_grey), largest_difference(a.right_grey, b.right_grey));
  std::vector<double> px, px_sigmas, mm, mm_sigmas;
  std::tie(d.matches, d.matches_alone) =
      pair_up(accepted(a), accepted(b), [&](const RecordedMatch& one, const RecordedMatch& other) {
        px.push_back(std::abs(double{one.disparity_px} - double{other.disparity_px}));
        px_sigmas.push_back(px.back() / double{one.sigma_px});
      });
  std::tie(d.points, d.points_alone) =
      pair_up(points(a), points(b), [&](const pipeline::CloudPoint& one, const pipeline::CloudPoint& other) {
        mm.push_back(pipeline::distance(pipeline::wide(one.at_mm), pipeline::wide(other.at_mm)));
        mm_sigmas.push_back(mm.back() / double{one.sigma_mm});
      });
  d.disparity_px = spread_of(std::move(px)), d.disparity_sigmas = spread_of(std::move(px_sigmas));
  d.point_mm = spread_of(std::move(mm)), d.point_sigmas = spread_of(std::move(mm_sigmas));
  d.surface_mm = spread_of(distances(a, b));
  d.colour_share = colour_share(a, b);
  return d;
}

}  // namespace relievo::bench
