// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/light/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Histogram = std::array<int, 256>;
constexpr double kHalfWidthMm = 50, kUpMm = 62, kDownMm = 50;  // about the tip of the nose
// The two zones whose histograms are compared: squares of 0.3 eye distances outside of the pupils, half way
// down to the mouth (OFIQ).
constexpr double kPupilMm = 31.5, kZoneMm = 19;
constexpr double kDegree = std::numbers::pi / 180,
                 kCheekDeg = 48;  // a cheek in these zones looks so far aside
constexpr double kMostTurnDeg = 20;
constexpr int kGlossStep = 55;  // levels above the median of the face

Histogram zone(const Relief& relief, const HeadMeasurement& head, double side) {
  Histogram counts{};
  const double step = std::max(0.8, head.tip_mm.z / relief.focal_px);
  for (double right = kPupilMm; right < kPupilMm + kZoneMm; right += step)
    for (double down = -kZoneMm / 2; down < kZoneMm / 2; down += step) {
      const FacePlace at = place_on(relief, head, side * right, down);
      if (at.inside) ++counts[relief.grey[relief.index(at.x, at.y)]];
    }
  return counts;
}

double mean_of(const Histogram& counts) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += double(i) * counts[i], all += counts[i];
  return all > 0 ? sum / all : 0;
}

// Of a cheek's light when the head faces the rig, and with it the lamps, to when it is turned away from that
// cheek by so much (Lambert).
double turned_share(double away_deg) {
  const double turned = std::clamp(away_deg, -kMostTurnDeg, kMostTurnDeg) * kDegree;
  return std::cos(kCheekDeg * kDegree) / std::cos(kCheekDeg * kDegree + turned);
}

constexpr double kHalfMm = 36;    // half the side of the window
constexpr double kGridMm = 0.38;  // finer pictures are made coarser: smaller blurs are of no account
constexpr double kLittleMm = 0.7, kMuchMm = 1.4;  // the two blurs that are compared
constexpr int kTiles = 6;
constexpr double kLeastOfStrongest = 0.3;  // an edge, against the strongest
constexpr double kLeastOfNoise = 5;
constexpr std::size_t kLeastEdges = 12;
constexpr double kSharpest = 0.75;  // which part of the edges speaks: others are soft by themselves
// What central differences and the square cell blur by themselves, pixels squared.
constexpr double kOwnBlur = 1.0 / 3 + 1.0 / 12;

struct Grid : Plane<float> {
  using Plane::Plane;
  double pixel_mm = 0;
  float at(int x, int y) const { return row(y)[x]; }
};

int luminance(const ImageView& image, int x, int y) {
  const std::uint8_t* row = image.row(y);
  switch (image.format) {
    case PixelFormat::Rgb8: return (row[3 * x] + row[3 * x + 1] + row[3 * x + 2]) / 3;
    case PixelFormat::Grey16: return row[2 * x + 1];
    case PixelFormat::Grey8: break;
  }
  return row[x];
}

// The face about `at`, a camera's point, as its picture shows it.
Grid window(const ImageView& image, const CameraIntrinsics& camera, const Vec3d& at, StageContext& context) {
  const Vec2d middle = source_pixel(camera, {}, 1, {0, 0}, {at.x / at.z, at.y / at.z});
  const double pixels_a_mm = camera.focal_px.x / at.z;
  const int k = std::max(1, int(kGridMm * pixels_a_mm));
  const int half = int(kHalfMm * pixels_a_mm);
  const int x0 = std::max(0, int(middle.x) - half), x1 = std::min(image.width_px, int(middle.x) + half);
  const int y0 = std::max(0, int(middle.y) - half), y1 = std::min(image.height_px, int(middle.y) + half);
  Grid grid(&context.scratch, std::max(0, (x1 - x0) / k), std::max(0, (y1 - y0) / k));
  grid.pixel_mm = k / pixels_a_mm;
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      int sum = 0;
      for (int j = 0; j < k; ++j)
        for (int i = 0; i < k; ++i) sum += luminance(image, x0 + x * k + i, y0 + y * k + j);
      grid.row(y)[x] = float(sum) / float(k * k);
    }
  return grid;
}

void add_weighted(float weight, const float* from, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

Grid blurred(const Grid& from, double deviation_px, StageContext& context) {
  const int reach = std::max(1, int(std::ceil(3 * deviation_px)));
  std::pmr::vector<float> weight(std::size_t(2 * reach + 1), &context.scratch);
  float total = 0;
  for (int i = -reach; i <= reach; ++i)
    total += weight[std::size_t(i + reach)] = float(std::exp(-0.5 * i * i / (deviation_px * deviation_px)));
  for (float& w : weight) w /= total;
  Grid across(&context.scratch, from.width, from.height), to(&context.scratch, from.width, from.height);
  const auto width = std::size_t(from.width), beside = std::size_t(reach);
  std::pmr::vector<float> wide(width + 2 * beside, 0.0F, &context.scratch);  // a row, its ends repeated
  for (int y = 0; y < from.height; ++y) {
    const float* values = from.row(y);
    std::fill_n(wide.begin(), beside, values[0]);
    std::copy_n(values, width, wide.data() + beside);
    std::fill_n(wide.data() + beside + width, beside, values[width - 1]);
    for (std::size_t k = 0; k < weight.size(); ++k)
      add_weighted(weight[k], wide.data() + k, width, across.row(y));
  }
  for (int y = 0; y < from.height; ++y)
    for (int k = -reach; k <= reach; ++k) {
      const float* other = across.row(std::clamp(y + k, 0, from.height - 1));
      add_weighted(weight[std::size_t(k + reach)], other, width, to.row(y));
    }
  return to;
}

// Deviation of a cell's noise, after Immerkaer (Fast noise variance estimation, 1996), on the flattest
// quarter of the tiles.
double noise_of(const Grid& g) {
  std::array<double, kTiles * kTiles> sum{}, count{};
  for (int y = 1; y + 1 < g.height; ++y)
    for (int x = 1; x + 1 < g.width; ++x) {
      const auto tile = std::size_t(y * kTiles / g.height * kTiles + x * kTiles / g.width);
      const float second = g.at(x - 1, y - 1) + g.at(x + 1, y - 1) + g.at(x - 1, y + 1) + g.at(x + 1, y + 1) -
                           2 * (g.at(x, y - 1) + g.at(x, y + 1) + g.at(x - 1, y) + g.at(x + 1, y)) +
                           4 * g.at(x, y);
      sum[tile] += double(std::abs(second));
      count[tile] += 1;
    }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= std::max(1.0, count[i]);
  std::ranges::sort(sum);
  return std::sqrt(1.5707963) / 6 * sum[sum.size() / 4];
}

struct Slope {
  float little = 0, much = 0;  // across the edge, at either blur
};

// What a bell of this deviation leaves of the deviation of white noise in a central difference.
double of_noise(double deviation_px) { return 1 / (std::sqrt(8 * 3.14159265) * deviation_px * deviation_px); }

// Deviation of the edges' own blur, grid cells squared; of edges whose slope is greatest in this direction.
double edge_blur(std::pmr::vector<Slope>& edges, double noise, double little_px, double much_px,
                 StageContext& context) {
  float strongest = 0;
  for (const Slope& e : edges) strongest = std::max(strongest, std::abs(e.much));
  const double n1 = noise * of_noise(little_px), n2 = noise * of_noise(much_px);
  const double least = std::max(kLeastOfStrongest * double(strongest), kLeastOfNoise * n2);
  std::pmr::vector<double> ratio(&context.scratch);
  ratio.reserve(edges.size());
  for (const Slope& e : edges) {
    const auto a = double(e.little), b = double(e.much);
    if (std::abs(b) >= least) ratio.push_back((a * a - n1 * n1) / (b * b - n2 * n2));
  }
  if (ratio.size() < kLeastEdges) return 1e9;
  const double r = std::max(percentile(ratio, kSharpest), 1 + 1e-6);
  return std::max(0.0, (much_px * much_px - r * little_px * little_px) / (r - 1) - kOwnBlur);
}

double blur_of(const Grid& grid, StageContext& context) {
  if (grid.width < 24 || grid.height < 24) return kMostBlurMm;
  const double little_px = kLittleMm / grid.pixel_mm, much_px = kMuchMm / grid.pixel_mm;
  const Grid little = blurred(grid, little_px, context), much = blurred(grid, much_px, context);
  std::array<std::pmr::vector<Slope>, 2> edges{std::pmr::vector<Slope>(&context.scratch),
                                               std::pmr::vector<Slope>(&context.scratch)};
  for (auto& e : edges) e.reserve(grid.values.size());
  const auto slope = [](const Grid& g, int x, int y, int dx, int dy) {
    return (g.at(x + dx, y + dy) - g.at(x - dx, y - dy)) / 2;
  };
  for (int y = 2; y + 2 < grid.height; ++y)
    for (int x = 2; x + 2 < grid.width; ++x) {
      const bool across = std::abs(slope(much, x, y, 1, 0)) > std::abs(slope(much, x, y, 0, 1));
      const int dx = across ? 1 : 0, dy = across ? 0 : 1;
      const float here = slope(much, x, y, dx, dy);
      // The steepest place of an edge only.
      if (std::abs(here) < std::abs(slope(much, x + dx, y + dy, dx, dy)) ||
          std::abs(here) <= std::abs(slope(much, x - dx, y - dy, dx, dy)))
        continue;
      edges[across ? 0 : 1].push_back({slope(little, x, y, dx, dy), here});
    }
  const double noise = noise_of(grid);
  const double a = edge_blur(edges[0], noise, little_px, much_px, context),
               b = edge_blur(edges[1], noise, little_px, much_px, context);
  // Where one direction has no edges, the other speaks.
  const double squared = a >= 1e9 || b >= 1e9 ? std::min(a, b) : std::max(a, b);
  return std::min(kMostBlurMm, std::sqrt(squared) * grid.pixel_mm);
}

}  // namespace

FaceLight measure_light(const Relief& relief, const HeadMeasurement& head) {
  FaceLight light;
  if (!head.known) return light;
  Histogram counts{};
  int all = 0;
  const double step = std::max(1.0, head.tip_mm.z / relief.focal_px);
  for (double down = -kUpMm; down <= kDownMm; down += step)
    for (double right = -kHalfWidthMm; right <= kHalfWidthMm; right += step) {
      const double v = down < 0 ? down / kUpMm : down / kDownMm, u = right / kHalfWidthMm;
      if (u * u + v * v > 1) continue;
      const FacePlace at = place_on(relief, head, right, down);
      if (!at.inside || !relief.known(at.x, at.y)) continue;
      ++counts[relief.grey[relief.index(at.x, at.y)]];
      ++all;
    }
  if (all < 200) return light;
  light.known = true;
  int middle = 0;  // the median
  for (int seen = 0; middle < 255 && (seen += counts[std::size_t(middle)]) * 2 < all;) ++middle;
  const int gloss = middle + kGlossStep;
  for (int i = 0; i < 256; ++i) {
    const double share = double(counts[std::size_t(i)]) / all;
    light.luminance_mean += share * i / 255.0;
    if (i <= 25) light.dark_share += share;
    if (i >= 247) light.bright_share += share;
    if (i >= gloss) light.glossy_share += share;
  }
  const double a = mean_of(zone(relief, head, -1)), b = mean_of(zone(relief, head, 1));
  const double lit = b * turned_share(head.yaw_deg),
               other = a * turned_share(-head.yaw_deg);  // as on a head that is not turned
  light.side_ratio = std::max(lit, other) > 0 ? std::min(lit, other) / std::max(lit, other) : 0;
  return light;
}

double measure_blur_mm(const StereoFrame& frame, const StereoCalibration& calibration, const Relief& relief,
                       const HeadMeasurement& head, StageContext& context) {
  if (!head.known || frame.left.empty() || frame.right.empty()) return 0;
  Arena::Mark mark(context.scratch);
  const Vec3d p = along(head.tip_mm, -18, head.down);  // the middle between nose and eyes
  const Vec3d in_left = apply(transposed(relief.rectified_from_left), p),
              in_right = apply(calibration.right_from_left, in_left);
  const double left = blur_of(window(frame.left, calibration.left, in_left, context), context);
  return std::max(left, blur_of(window(frame.right, calibration.right, in_right, context), context));
}

}  // namespace relievo::pipeline
