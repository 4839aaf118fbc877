// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a plane, denser than pixels and as far as each other, must look alike everywhere, whatever
// size the screen scales their picture to: a pattern as fine as pixels beats against those of the screen
// (Moiré).
#include "firmware/work/stage_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

namespace relievo::firmware {
namespace {

constexpr int kSide = 400;

using Picture = std::vector<double>;

pipeline::RectifiedPair pair_of(int side_px) {
  pipeline::RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = pair.height_px = side_px;
  return pair;
}

// One point a pixel of the view.
pipeline::PointCloud plane(int side_px) {
  pipeline::PointCloud cloud(std::pmr::get_default_resource());
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x) {
      pipeline::CloudPoint point;
      point.at_mm = {static_cast<float>(x), static_cast<float>(y), 400};
      point.left_px = {static_cast<float>(x), static_cast<float>(y)};
      cloud.points.push_back(point);
    }
  }
  return cloud;
}

Picture green_of(const std::vector<std::uint8_t>& rgb) {
  Picture green;
  for (std::size_t i = 1; i < rgb.size(); i += 3) green.push_back(rgb[i]);
  return green;
}

// As GL_LINEAR does.
Picture scaled(const Picture& from, int to_side) {
  Picture to;
  for (int y = 0; y < to_side; ++y) {
    for (int x = 0; x < to_side; ++x) {
      const auto at = [&](int i) {
        return std::clamp((i + 0.5) * kSide / to_side - 0.5, 0.0, kSide - 1.001);
      };
      const double u = at(x), v = at(y);
      const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
      const double s = u - static_cast<double>(i), t = v - static_cast<double>(j);
      const double* row = &from[j * kSide + i];
      to.push_back((1 - t) * ((1 - s) * row[0] + s * row[1]) +
                   t * ((1 - s) * row[kSide] + s * row[kSide + 1]));
    }
  }
  return to;
}

// The standard deviation in each window of 24 pixels.
std::vector<double> contrasts(const Picture& picture, int side) {
  constexpr int kWindow = 24;
  std::vector<double> all;
  for (int y = kWindow; y + 2 * kWindow <= side; y += kWindow) {
    for (int x = kWindow; x + 2 * kWindow <= side; x += kWindow) {
      double sum = 0, squares = 0;
      for (int v = y; v < y + kWindow; ++v) {
        for (int u = x; u < x + kWindow; ++u) {
          const double value = picture[static_cast<std::size_t>(v) * static_cast<std::size_t>(side) +
                                       static_cast<std::size_t>(u)];
          sum += value, squares += value * value;
        }
      }
      const double n = kWindow * kWindow, mean = sum / n;
      all.push_back(std::sqrt(std::max(0.0, squares / n - mean * mean)));
    }
  }
  return all;
}

TEST(StageDrawing, PointsLookAlikeEverywhereAtWhateverSizeTheyAreShown) {
  for (const int view_px : {400, 777, 1200}) {  // pixels of the view, one point each
    std::vector<std::uint8_t> rgb(std::size_t{3} * kSide * kSide);
    StageCanvas canvas(rgb.data(), kSide);
    draw_cloud(pair_of(view_px), plane(view_px), canvas);
    const Picture drawn = green_of(rgb);
    for (const int shown_px : {262, 310, 372, 400, 431, 476}) {
      const std::vector<double> all = contrasts(scaled(drawn, shown_px), shown_px);
      const auto [least, most] = std::ranges::minmax_element(all);
      EXPECT_GT(*least, 10) << "dots are seen: " << view_px << " -> " << shown_px;
      EXPECT_LT(*most / *least, 1.35) << view_px << " -> " << shown_px;
    }
  }
}

TEST(StageDrawing, OfPointsFewAndFarBetweenNoneIsLostAndNothingElseIsTouched) {
  std::vector<std::uint8_t> rgb(std::size_t{3} * kSide * kSide), empty = rgb;
  StageCanvas blank(empty.data(), kSide);
  pipeline::PointCloud cloud(std::pmr::get_default_resource());
  for (const float at :
       {-3.0F, 0.0F, 50.5F, 120.25F, 399.9F, 800.0F}) {  // the first and the last lie outside
    pipeline::CloudPoint point;
    point.at_mm = {at, at, 400 + at};
    point.left_px = {at, at};
    cloud.points.push_back(point);
  }
  StageCanvas canvas(rgb.data(), kSide);
  draw_cloud(pair_of(kSide), cloud, canvas);
  for (const std::size_t at : {std::size_t{0}, std::size_t{50}, std::size_t{120}, std::size_t{399}}) {
    EXPECT_NE(rgb[3 * (at * kSide + at) + 1], empty[3 * (at * kSide + at) + 1]) << at;
  }
  std::size_t touched = 0;
  for (std::size_t i = 1; i < rgb.size(); i += 3) touched += rgb[i] != empty[i] ? 1 : 0;
  EXPECT_LT(touched, 4 * 36U);
}

// A square before the head, 100 mm wide, facing forward, and a smaller one behind it.
TEST(StageDrawing, AHeadStandsInTheMiddleAtItsScaleAndTurns) {
  pipeline::FaceMesh mesh(std::pmr::get_default_resource());
  const auto square = [&mesh](float half_mm, float z_mm) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (const auto& [x, y] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
      mesh.vertices_mm.push_back({30 + half_mm * x, half_mm * y, z_mm});
      mesh.normals.push_back({0, 0, 1});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  square(50, 0);
  square(10, -100);
  const auto columns = [&mesh](double turned_deg) {
    std::vector<std::uint8_t> rgb(std::size_t{3} * kSide * kSide), empty = rgb;
    StageCanvas blank(empty.data(), kSide), canvas(rgb.data(), kSide);
    draw_head(mesh, {{{1, 0, 0, 0, 1, 0, 0, 0, 1}}, {0, 0, 0}}, turned_deg, 200, canvas);
    std::vector<int> held;
    for (int x = 0; x < kSide; ++x) {
      const std::size_t at = 3 * (std::size_t{kSide} * (kSide / 2) + static_cast<std::size_t>(x));
      if (rgb[at] != empty[at]) held.push_back(x);
    }
    return held;
  };
  const std::vector<int> front = columns(0);
  EXPECT_NEAR(static_cast<double>(front.size()), 200, 2) << "100 of 200 mm";
  EXPECT_NEAR(0.5 * (front.front() + front.back()), kSide / 2, 1);
  EXPECT_GT(columns(50).size(), 0U);
  EXPECT_NE(columns(50), front);
  EXPECT_EQ(columns(50).size(), columns(-50).size());
}

}  // namespace
}  // namespace relievo::firmware
