// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_traits.h"

#include <array>

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

// A man's and a woman's mean and the common deviation.
double measure(Random& r, const HeadTraits& t, double man, double woman, double deviation) {
  return mix(woman, man, t.masculine) + deviation * r.normal_within(1.9);
}

void draw_looks(Random& r, HeadTraits& t) {
  static constexpr std::array<Vec3, 6> kSkin{Vec3{0.70, 0.47, 0.37}, {0.62, 0.40, 0.30}, {0.52, 0.31, 0.21},
                                             {0.40, 0.22, 0.14},     {0.25, 0.13, 0.08}, {0.14, 0.07, 0.045}};
  static constexpr std::array<Vec3, 5> kIris{Vec3{0.16, 0.25, 0.34},
                                             {0.15, 0.21, 0.15},
                                             {0.20, 0.12, 0.05},
                                             {0.10, 0.05, 0.025},
                                             {0.05, 0.025, 0.015}};
  static constexpr std::array<Vec3, 5> kHair{Vec3{0.42, 0.29, 0.15},
                                             {0.20, 0.115, 0.055},
                                             {0.09, 0.05, 0.028},
                                             {0.035, 0.022, 0.015},
                                             {0.014, 0.011, 0.010}};
  // Light skin goes with any eyes and hair, dark skin with dark ones.
  const double tone = std::pow(r.uniform(), 1.3) * 4.6;
  const auto between = [](const auto& table, double at) {
    const auto i = std::size_t(std::clamp(at, 0.0, double(table.size()) - 1.001));
    return mix(table[i], table[i + 1], at - double(i));
  };
  t.skin = between(kSkin, tone);
  t.iris = between(kIris, std::min(3.9, std::max(r.uniform(0, 3.9), tone * 1.5)));
  t.hair = between(kHair, std::min(3.9, std::max(r.uniform(0.2, 3.9), tone * 1.3)));
  if (t.age > 0.6)
    t.hair = mix(t.hair, Vec3{0.45, 0.44, 0.43}, smoothstep(0.6, 1.0, t.age) * r.uniform(0.3, 1));
  t.freckles = tone < 2 ? std::pow(r.uniform(), 2) : 0.15 * r.uniform();
  t.stubble = t.masculine > 0.55 ? r.uniform(0.2, 1) : 0;
  t.hairline_y = r.uniform(62, 76) + (t.masculine > 0.55 ? 9 * t.age : 0);
  t.hair_length = r.uniform(8, 34);
  t.brow_density = r.uniform(0.7, 1.25) * mix(0.85, 1.15, t.masculine);
  t.hair_part = r.uniform(-1, 1);
  t.shirt = int(r.next() % 6);
}

}  // namespace

HeadTraits traits_of(std::uint32_t seed) {
  Random r(0x48454144ULL + seed);
  HeadTraits t;
  t.seed = seed;
  t.masculine = smoothstep(0.15, 0.85, r.uniform());
  t.age = std::pow(r.uniform(), 1.4);
  t.head_breadth = measure(r, t, 151, 145, 4.5);
  t.face_breadth = measure(r, t, 138, 131, 4.6);
  t.jaw_breadth = measure(r, t, 108, 98, 5);
  t.head_length = measure(r, t, 196, 187, 5);
  t.nose_height = measure(r, t, 53.5, 50, 2.4);
  t.upper_lip = measure(r, t, 22.3, 20.3, 1.6);
  t.lower_face = measure(r, t, 49.5, 45, 3.0);
  t.nose_width = measure(r, t, 36, 33, 3.0);
  t.nose_protrusion = measure(r, t, 19.8, 19.0, 1.4);
  t.intercanthal = measure(r, t, 33, 32, 1.9);
  t.eye_fissure = measure(r, t, 31.2, 30.4, 1.1);
  t.mouth_width = measure(r, t, 53.5, 50, 2.8);
  t.ear_height = measure(r, t, 62.5, 59, 2.8);
  for (double* form : {&t.brow_ridge, &t.bridge, &t.hump, &t.tip_up, &t.tip_size, &t.lip_fullness,
                       &t.cheekbone, &t.fullness, &t.chin, &t.eye_tilt, &t.eye_open, &t.forehead, &t.lid_fold,
                       &t.ear_out, &t.eye_depth, &t.mouth_curve, &t.chin_breadth})
    *form = r.normal_within(1.7);
  t.brow_ridge += 1.4 * (t.masculine - 0.5);
  t.lip_fullness -= 0.9 * (t.masculine - 0.5);
  t.chin_breadth += 1.2 * (t.masculine - 0.5);
  draw_looks(r, t);
  return t;
}

}  // namespace relievo::hal::sim
