// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/truth.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "hal/sim/base/text.h"
#include "hal/whole_file.h"

namespace relievo::hal::sim {
namespace {

constexpr double kCosSixty = 0.5;

std::uint8_t flags_of(const Scene& scene, const SimRig& rig, const SolidPoint& s, Vec3 left_ray) {
  std::uint8_t flags = s.skin ? Truth::kSkin : std::uint8_t{0};
  const Vec3 to_right = rig.right.centre() - s.point;
  const double far = length(to_right);
  const Vec3 right_ray = to_right * (1 / far);
  const Pixel q = rig.right.project(s.point);
  const bool inside = q.x > 2 && q.y > 2 && q.x < rig.right.width_px - 3 && q.y < rig.right.height_px - 3;
  // A step back towards the left camera keeps the surface from hiding itself.
  if (!inside || scene.blocked(s.point - left_ray * 0.08, right_ray, far - 0.2)) return flags;
  flags |= Truth::kSeenByBoth;
  if (std::min(std::abs(dot(s.normal, left_ray)), std::abs(dot(s.normal, right_ray))) > kCosSixty)
    flags |= Truth::kNotGrazing;
  return flags;
}

template <typename T>
void append(std::vector<std::byte>& out, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  out.insert(out.end(), bytes.begin(), bytes.end());
}
void append_text(std::vector<std::byte>& out, const std::string& s) { append<char>(out, s); }

}  // namespace

Truth measure_truth(const Scene& scene, const SimRig& rig, ThreadPool& pool) {
  Truth truth;
  truth.width_px = rig.left.width_px;
  truth.height_px = rig.left.height_px;
  const std::size_t count =
      static_cast<std::size_t>(truth.width_px) * static_cast<std::size_t>(truth.height_px);
  truth.depth_mm.assign(count, std::numeric_limits<float>::quiet_NaN());
  truth.flags.assign(count, 0);
  const Vec3 eye = rig.left.centre();
  pool.for_each_band(truth.height_px, 60, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < truth.width_px; ++x) {
        const Vec3 ray = rig.left.ray(x, y);
        SolidPoint s;
        if (!scene.solid(eye, ray, s)) continue;
        truth.depth_mm[truth.at(x, y)] = static_cast<float>(rig.left.depth_mm(s.point));
        truth.flags[truth.at(x, y)] = flags_of(scene, rig, s, ray);
      }
  });
  return truth;
}

Result<void> write_truth(const std::filesystem::path& file, const Truth& truth) {
  std::vector<std::byte> out;
  append_text(out, text("%d %d z\n", truth.width_px, truth.height_px));
  append<float>(out, truth.depth_mm);
  append<std::uint8_t>(out, truth.flags);
  return write_whole_file(file, out);
}

Result<void> write_mesh(const std::filesystem::path& file, const Mesh& mesh) {
  std::vector<std::byte> out;
  append_text(
      out,
      text(
          "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n",
          mesh.points.size()));
  append_text(out, text("element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
                        mesh.triangles.size()));
  out.reserve(out.size() + mesh.points.size() * 12 + mesh.triangles.size() * 13);
  append<std::array<float, 3>>(out, mesh.points);
  for (const auto& t : mesh.triangles) {
    out.push_back(std::byte{3});
    append<std::uint32_t>(out, t);
  }
  return write_whole_file(file, out);
}

}  // namespace relievo::hal::sim
