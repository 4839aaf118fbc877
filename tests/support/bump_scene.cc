// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bump_scene.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace relievo::test {
namespace {

// A sum of waves of 5 to 20 pixels' length in random directions: band-limited, so that sampling it is exact.
struct Texture {
  struct Wave {
    double kx, ky, phase;
  };
  std::array<Wave, 48> waves{};
  double scale;

  Texture(std::uint32_t seed, double contrast)
      : scale(contrast / std::sqrt(static_cast<double>(waves.size()) / 2)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (Wave& wave : waves) {
      const double length = 5 + 15 * unit(random);
      const double angle = 6.283185307 * unit(random);
      wave = {6.283185307 / length * std::cos(angle), 6.283185307 / length * std::sin(angle),
              6.283185307 * unit(random)};
    }
  }
  double at(double x, double y) const {
    double sum = 0;
    for (const Wave& wave : waves) sum += std::cos(wave.kx * x + wave.ky * y + wave.phase);
    return 128 + scale * sum;
  }
};

}  // namespace

double BumpScene::disparity(double x, double y) const {
  const double dx = x - width_px / 2.0;
  const double dy = y - height_px / 2.0;
  const double r2 = (dx * dx + dy * dy) / (bump_radius_px * bump_radius_px);
  return base_px + tilt * dx + bump_px * std::exp(-r2) + ripple_px * ripple(x) - groove_px * groove(y);
}

double BumpScene::ripple(double x) const { return std::sin(2 * std::numbers::pi * x / ripple_period_px); }

double BumpScene::groove(double y) const {
  const double v = (y - 0.75 * height_px) / groove_radius_px;
  return std::exp(-0.5 * v * v);
}

bool BumpScene::judged(double x, double y) const {
  constexpr double kMargin = 24;
  const double right = x - disparity(x, y);
  return x > kMargin && y > kMargin && x < width_px - kMargin && y < height_px - kMargin && right > kMargin;
}

double BumpScene::moved(double x, double y) const {
  const double u = (x - width_px / 2.0) / moved_radius_px, v = (y - 0.7 * height_px) / moved_radius_px;
  return moved_px * std::exp(-0.5 * (u * u + v * v));
}

pipeline::RectifiedPair BumpScene::render(std::pmr::memory_resource* memory) const {
  pipeline::RectifiedPair pair(memory);
  pair.width_px = width_px;
  pair.height_px = height_px;
  // A face-like rig: the plane stands at 560 mm, one pixel is 0.37 mm wide and 2.1 mm deep.
  constexpr double kFocal = 1500;
  constexpr double kBaseline = 100;
  constexpr double kDistance = 560;
  pair.focal_px = kFocal;
  pair.baseline_mm = kBaseline;
  pair.left_centre_px = {width_px / 2.0, height_px / 2.0};
  pair.right_centre_px = {width_px / 2.0 - (base_px - kFocal * kBaseline / kDistance), height_px / 2.0};
  pair.near_mm = 510;
  pair.far_mm = 620;
  pair.right_from_left.translation_mm = {-kBaseline, 0, 0};
  const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  if (face) pair.region.assign(pixels, 1);
  const Texture texture(seed, contrast);
  std::mt19937 random(seed + 1000);
  std::normal_distribution<double> normal(0, noise);
  for (pipeline::RectifiedView* view : {&pair.left, &pair.right}) {
    view->grey.resize(pixels);
    view->rgb.assign(3 * pixels, 128);
    view->valid.assign(pixels, 1);
  }
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const auto k =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x);
      pair.left.grey[k] =
          static_cast<float>((1 - groove_dark * groove(y)) * texture.at(x, y) + normal(random));
      const double row = y - rows_px - rows_tilt * (x - width_px / 2.0) - moved(x, y);
      double from = x + disparity(x, row);  // x_left with x_left - d(x_left) = x
      for (int i = 0; i < 60; ++i) from = x + disparity(from, row);
      pair.right.grey[k] =
          static_cast<float>(right_gain * (1 - groove_dark * groove(row)) * texture.at(from, row) +
                             right_offset + normal(random));
    }
  return pair;
}

pipeline::Keypoints lattice(const pipeline::RectifiedPair& pair, int step_px,
                            std::pmr::memory_resource* memory) {
  pipeline::Keypoints keypoints(memory);
  keypoints.lattice_step_px = step_px;
  for (int y = 0; y < pair.height_px; y += step_px)
    for (int x = 0; x < pair.width_px; x += step_px)
      keypoints.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
  return keypoints;
}

}  // namespace relievo::test
