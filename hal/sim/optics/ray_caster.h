// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RayCaster: triangles and hair strands, and what a ray meets first. Hides the ray tracing library.
// Thread: building: one; asking: any number at once, after commit().
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

struct Mesh {  // millimetres
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

inline Vec3 point_of(const Mesh& mesh, std::size_t i) {
  const auto& p = mesh.points[i];
  return {double(p[0]), double(p[1]), double(p[2])};
}
inline std::array<float, 3> to_floats(Vec3 p) { return {float(p.x), float(p.y), float(p.z)}; }

// Interpolates over a triangle: weights 1 - u - v, u, v.
template <typename T>
T blend_corners(const std::vector<T>& values, const std::array<std::uint32_t, 3>& corner, double u,
                double v) {
  using Number = std::conditional_t<std::is_same_v<T, float>, float, double>;
  return values[corner[0]] * static_cast<Number>(1 - u - v) + values[corner[1]] * static_cast<Number>(u) +
         values[corner[2]] * static_cast<Number>(v);
}

struct Strands {
  struct Node {
    float x, y, z, radius_mm;
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> pieces;  // index of the first node of every straight piece
};

struct Hit {
  double distance_mm = 0;
  int body = -1;  // which mesh, in the order of add(); of strands from kFirstStrands on
  std::uint32_t primitive = 0;
  double u = 0, v = 0;  // barycentric, of the second and third corner
};

class RayCaster {
 public:
  static constexpr double kFar = 1e9;
  static constexpr int kFirstStrands = 1000;
  RayCaster();
  ~RayCaster();

  // Copies. Meshes alone block light and define the truth: strands are never solid.
  void add(const Mesh& mesh);
  void add(const Strands& strands);
  void commit();

  enum class Against : std::uint8_t { Everything, SolidOnly };
  bool cast(Vec3 origin, Vec3 direction, Hit& hit, Against against = Against::Everything) const;
  bool blocked(Vec3 origin, Vec3 direction, double far_mm) const;  // by solid bodies

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace relievo::hal::sim
