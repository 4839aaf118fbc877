// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>
#include <vector>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include "tests/support/recognition/nearest_points.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Numbered = std::pair<Kernel::Point_3, std::uint32_t>;
using Traits = CGAL::Search_traits_adapter<Numbered, CGAL::First_of_pair_property_map<Numbered>,
                                           CGAL::Search_traits_3<Kernel>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;

std::vector<Numbered> numbered(std::span<const Vec3f> points) {
  std::vector<Numbered> out;
  out.reserve(points.size());
  for (const Vec3f& p : points)
    out.emplace_back(
        Kernel::Point_3(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)),
        static_cast<std::uint32_t>(out.size()));
  return out;
}

}  // namespace

struct NearestPoints::Tree {
  explicit Tree(const std::vector<Numbered>& points) : of(points.begin(), points.end()) { of.build(); }
  Search::Tree of;  // built before the first question: building later would not be safe among threads
};

NearestPoints::NearestPoints(std::span<const Vec3f> points_mm)
    : tree_(std::make_unique<const Tree>(numbered(points_mm))) {}
NearestPoints::~NearestPoints() = default;
NearestPoints::NearestPoints(NearestPoints&&) noexcept = default;
NearestPoints& NearestPoints::operator=(NearestPoints&&) noexcept = default;

std::uint32_t NearestPoints::nearest(const Vec3d& to_mm) const {
  return Search(tree_->of, Kernel::Point_3(to_mm.x, to_mm.y, to_mm.z), 1).begin()->first.second;
}

}  // namespace relievo::pipeline
