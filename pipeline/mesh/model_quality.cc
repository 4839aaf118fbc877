// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/model_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// What a visitor looks at first, in the head's frame; mm. The mouth lies that far below the nose, however it
// is opened.
struct Feature {
  double x, y, half_width, half_height;
};
constexpr Feature kFeatures[] = {{0, -44, 24, 12}, {0, 0, 14, 14}, {31, 38, 15, 8}, {-31, 38, 15, 8}};

struct Share {
  double measured = 0, all = 0;
  double value() const { return all > 0 ? measured / all : 0; }
};

// The paper blurs with a mean of nine; two neighbours' means differ by a ninth of what entered and left.
constexpr int kMean = 9;
constexpr int kAhead = kMean / 2;
constexpr int kBehind = kAhead + 1;

struct Variation {
  double all = 0, lost = 0;
};  // of neighbours, and how much of it one more blur takes

// `step`: from one texel to the next along the direction looked in.
void add_line(const std::uint8_t* luminance, const std::uint8_t* origin, std::size_t step, int count,
              Variation& sum) {
  int run = 0;
  for (int i = 0; i < count; ++i) {
    run = origin[std::size_t(i) * step] >= kLeftPhotographTexel ? run + 1 : 0;
    if (run < kAhead + kBehind + 1) continue;
    const auto at = [&](int back) { return int(luminance[std::size_t(i - back) * step]); };
    const int own = kMean * std::abs(at(kAhead) - at(kAhead + 1));
    const int blurred = std::abs(at(0) - at(kMean));
    sum.all += own;
    sum.lost += std::max(0, own - blurred);
  }
}

}  // namespace

ModelQuality measure_quality(const FaceMesh& mesh, const HeadFrame& frame, StageContext& context) {
  ModelQuality quality;
  Share face;
  std::array<Share, std::size(kFeatures)> features;
  for (const auto& t : mesh.triangles) {
    const Vec3f &a = mesh.vertices_mm[t[0]], &b = mesh.vertices_mm[t[1]], &c = mesh.vertices_mm[t[2]];
    const double area = 0.5 * length(cross(wide(minus(b, a)), wide(minus(c, a))));
    const double measured = all_three(mesh.measured, t) ? area : 0;
    const auto add = [&](Share& share) {
      share.all += area;
      share.measured += measured;
    };
    add(face);
    const Vec3d p = apply(frame.head_from_camera, wide(a));
    for (std::size_t i = 0; i < features.size(); ++i)
      if (std::abs(p.x - kFeatures[i].x) < kFeatures[i].half_width &&
          std::abs(p.y - kFeatures[i].y) < kFeatures[i].half_height)
        add(features[i]);
  }
  quality.measured_area_mm2 = face.measured;
  quality.coverage = face.value();
  for (const Share& feature : features) quality.coverage = std::min(quality.coverage, feature.value());
  Arena::Mark mark(context.scratch);
  std::pmr::vector<float> sigma(&context.scratch);
  sigma.reserve(mesh.sigma_mm.size());
  for (std::size_t k = 0; k < mesh.sigma_mm.size(); ++k)
    if (mesh.measured[k] != 0) sigma.push_back(mesh.sigma_mm[k]);
  quality.median_sigma_mm = sigma.empty() ? 0 : median(sigma);
  quality.width_mm = frame.width_mm;
  quality.height_mm = frame.height_mm;
  quality.nose_relief_mm = frame.nose_relief_mm;
  quality.symmetry_residual_mm = frame.asymmetry_mm;
  return quality;
}

double texture_sharpness(const TextureAtlas& atlas, StageContext& context) {
  Arena::Mark mark(context.scratch);
  const std::size_t w = std::size_t(atlas.width_px);
  std::pmr::vector<std::uint8_t> luminance(atlas.origin.size(), 0, &context.scratch);
  for (std::size_t k = 0; k < luminance.size(); ++k)
    luminance[k] =
        std::uint8_t((77 * atlas.rgb[3 * k] + 150 * atlas.rgb[3 * k + 1] + 29 * atlas.rgb[3 * k + 2]) >> 8);
  Variation across;
  Variation down;
  for (int y = 0; y < atlas.height_px; ++y) {
    const std::size_t row = std::size_t(y) * w;
    add_line(&luminance[row], &atlas.origin[row], 1, atlas.width_px, across);
  }
  for (std::size_t x = 0; x < w; ++x) add_line(&luminance[x], &atlas.origin[x], w, atlas.height_px, down);
  // The more blurred of the two directions is what is seen.
  const auto share = [](const Variation& v) { return v.all > 0 ? v.lost / v.all : 0.0; };
  return std::min(share(across), share(down));
}

}  // namespace relievo::pipeline
