// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds whose true surface is known: rendered heads (RELIEVO_TEST_DATA/rendered) and formulas.
// Left-camera frame, millimetres. left_px are the pixels of the left picture.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory_resource>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

inline std::optional<std::filesystem::path> rendered_head(const std::string& name) {
  const char* root = std::getenv("RELIEVO_TEST_DATA");
  if (root == nullptr) return std::nullopt;
  std::filesystem::path dir = std::filesystem::path(root) / "rendered" / name;
  if (!std::filesystem::exists(dir / "truth.bin")) return std::nullopt;
  return dir;
}

struct TruthOptions {
  int step_px = 2;
  double noise_mm = 0;       // along the line of sight
  double outlier_share = 0;  // points thrown 5 to 60 mm off
  std::uint8_t flags = 3;    // bit 0 face skin, bit 1 seen by both, bit 2 both angles under 60 degrees
  unsigned seed = 1;
};

// The numbers of one matrix in an OpenCV YAML file.
inline std::vector<double> yaml_numbers(const std::string& text, const std::string& name) {
  std::vector<double> numbers;
  const std::size_t at = text.find("\n" + name + ":");
  const std::size_t open = text.find('[', at);
  const std::size_t close = text.find(']', open);
  if (at == std::string::npos || open == std::string::npos || close == std::string::npos) return numbers;
  std::string list = text.substr(open + 1, close - open - 1);
  for (char& c : list)
    if (c == ',') c = ' ';
  std::istringstream in(list);
  for (double number = 0; in >> number;) numbers.push_back(number);
  return numbers;
}

// Direction of a pixel of a Brown-Conrady camera, z = 1.
inline Vec3d pixel_ray(const std::vector<double>& k, const std::vector<double>& d, double u, double v) {
  const double xd = (u - k[2]) / k[0];
  const double yd = (v - k[5]) / k[4];
  double x = xd;
  double y = yd;
  for (int i = 0; i < 12; ++i) {
    const double r2 = x * x + y * y;
    const double s = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    const double dx = 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x);
    const double dy = d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y;
    x = (xd - dx) / s;
    y = (yd - dy) / s;
  }
  return {x, y, 1};
}

inline PointCloud truth_cloud(const std::filesystem::path& dir, const TruthOptions& options,
                              std::pmr::memory_resource* memory = std::pmr::get_default_resource()) {
  std::ifstream rig(dir / "rig.yml");
  const std::string text((std::istreambuf_iterator<char>(rig)), std::istreambuf_iterator<char>());
  const std::vector<double> k = yaml_numbers(text, "K1");
  const std::vector<double> d = yaml_numbers(text, "D1");
  std::ifstream in(dir / "truth.bin", std::ios::binary);
  std::string line;
  std::getline(in, line);
  int w = 0;
  int h = 0;
  std::istringstream(line) >> w >> h;
  const std::size_t n = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  std::vector<float> z(n);
  std::vector<char> flag(n);
  in.read(reinterpret_cast<char*>(z.data()), static_cast<std::streamsize>(4 * n));
  in.read(flag.data(), static_cast<std::streamsize>(n));

  PointCloud cloud(memory);
  cloud.lattice_step_px = options.step_px;
  std::mt19937 random(options.seed);
  std::normal_distribution<double> noise(0, 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int y = 0; y < h; y += options.step_px)
    for (int x = 0; x < w; x += options.step_px) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
      const auto f = static_cast<std::uint8_t>(flag[i]);
      if (std::isnan(z[i]) || (f & options.flags) != options.flags) continue;
      const Vec3d ray = pixel_ray(k, d, x, y);
      const double l = std::sqrt(ray.x * ray.x + ray.y * ray.y + 1);
      double depth = static_cast<double>(z[i]) + options.noise_mm * noise(random) / l;
      if (uniform(random) < options.outlier_share)
        depth += (uniform(random) < 0.5 ? -1 : 1) * (5 + 55 * uniform(random));
      cloud.points.push_back(
          {{static_cast<float>(ray.x * depth), static_cast<float>(ray.y * depth), static_cast<float>(depth)},
           {static_cast<float>(x), static_cast<float>(y)},
           static_cast<float>(std::max(options.noise_mm, 0.02))});
    }
  return cloud;
}

// A surface z(x, y) seen by a pinhole camera (f = 1000 px, centre 320, 320) on a lattice; NaN where
// there is nothing. `depth` gets the ray's slopes x / z and y / z.
template <typename Depth>
PointCloud formula_cloud(int step_px, int size_px, Depth&& depth, double noise_mm = 0,
                         std::pmr::memory_resource* memory = std::pmr::get_default_resource()) {
  PointCloud cloud(memory);
  cloud.lattice_step_px = step_px;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1);
  for (int y = 0; y < size_px; y += step_px)
    for (int x = 0; x < size_px; x += step_px) {
      const double sx = (x - size_px / 2) / 1000.0;
      const double sy = (y - size_px / 2) / 1000.0;
      double z = depth(sx, sy);
      if (std::isnan(z)) continue;
      z += noise_mm * noise(random) / std::sqrt(1 + sx * sx + sy * sy);
      cloud.points.push_back({{static_cast<float>(sx * z), static_cast<float>(sy * z), static_cast<float>(z)},
                              {static_cast<float>(x), static_cast<float>(y)},
                              static_cast<float>(std::max(noise_mm, 0.02))});
    }
  return cloud;
}

// Depth of a sphere along the ray (sx, sy, 1); NaN where it misses.
inline double sphere_depth(double sx, double sy, double centre_z_mm, double radius_mm) {
  const double a = sx * sx + sy * sy + 1;
  const double disc = centre_z_mm * centre_z_mm - a * (centre_z_mm * centre_z_mm - radius_mm * radius_mm);
  return disc < 0 ? std::numeric_limits<double>::quiet_NaN() : (centre_z_mm - std::sqrt(disc)) / a;
}

}  // namespace relievo::pipeline
