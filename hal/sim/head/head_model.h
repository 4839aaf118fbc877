// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadModel: one person's geometry: skin, eyeballs, shirt and every hair, ready for rays, with the
// ambient light that reaches each point. Head frame (head_traits.h). Immutable once built.
#pragma once

#include <memory>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/head_hair.h"
#include "hal/sim/head/shape/head_field.h"
#include "hal/sim/head/shape/surface_mesher.h"

namespace relievo::hal::sim {

struct Shell {  // one solid body
  Mesh mesh;
  std::vector<Vec3> normals;
  std::vector<float> openness;  // 0 .. 1: how much of the sky a point sees
};

class HeadModel {
 public:
  enum Body : std::uint8_t { Skin, Eyes, Inner, Shirt, Teeth, Tongue, BodyCount };
  static constexpr int kHairBody = 1000;

  HeadModel(const HeadTraits& traits, ThreadPool& pool);

  HeadTraits traits;
  HeadField field;
  std::array<Shell, BodyCount> shells;
  HairStyle hair;
  RayCaster caster;
  std::array<Vec3, 2> eye_centres;  // left, right

 private:
  void build_skin(ThreadPool& pool);
  void build_eyes();
  void build_shirt(ThreadPool& pool);
  void build_mouth(ThreadPool& pool);  // nothing behind closed lips
  void measure_openness(ThreadPool& pool);
};

// Interpolates over a triangle: weights 1 - u - v, u, v.
template <typename T>
T blend_corners(const std::vector<T>& values, const std::array<std::uint32_t, 3>& corner, double u,
                double v) {
  using Number = std::conditional_t<std::is_same_v<T, float>, float, double>;
  return values[corner[0]] * static_cast<Number>(1 - u - v) + values[corner[1]] * static_cast<Number>(u) +
         values[corner[2]] * static_cast<Number>(v);
}

// Averages each value with its neighbours': takes the grain out of sampled light.
void smooth_over(const Mesh& mesh, std::vector<float>& values, int times);

// Cosine-weighted directions about a normal, stratified; turned by the hash.
Vec3 sky_direction(Vec3 normal, int i, int count, std::uint32_t hash);

}  // namespace relievo::hal::sim
