// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/head_model.h"

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

struct Brow {
  double inner, outer;  // |x|
  double base_y, arch, thickness;
  double middle_y(double s) const {
    return base_y + 6.5 * s - 6.5 * s * s * s * s + arch * std::sin(3.1 * s);
  }
  double half_height(double s) const {
    return thickness * smoothstep(-0.12, 0.12, s) * (1 - 0.72 * smoothstep(0.25, 1.0, s));
  }
};
Brow brow_of(const HeadTraits& t) {
  const double drawn = unit_from_hash(hash_cell(3, 1, 4, t.seed)),
               bent = unit_from_hash(hash_cell(1, 5, 9, t.seed));
  return {t.intercanthal / 2 - 4.5 + 3 * drawn, t.intercanthal / 2 + t.eye_fissure + 4.0,
          14.8 - 0.9 * t.brow_ridge + 0.6 * t.lid_fold, 0.2 + 2.6 * bent,
          mix(3.2, 4.6, t.masculine) * mix(0.85, 1.15, drawn)};
}

// A strand that starts at the root and grows along its direction, drawn to a height over the skin.
class Grower {
 public:
  Grower(const HeadField& field, std::uint32_t seed) : field_(field), random_(seed) {}
  Random& random() { return random_; }
  HairStyle take() { return std::move(out_); }

  struct Shape {
    double length = 0, root_radius = 0, height = 0;
    Vec3 direction, bend;  // bend is added to the direction from root to tip
    int nodes = 0;
    bool hug = false;  // keep at `height` over the skin
  };
  void grow(Vec3 root, const Shape& s) {
    const auto tint = float(0.8 + 0.4 * random_.uniform());
    Vec3 p = root, direction = normalised(s.direction);
    for (int i = 0; i < s.nodes; ++i) {
      const double t = double(i) / (s.nodes - 1);
      if (i + 1 < s.nodes) out_.strands.pieces.push_back(std::uint32_t(out_.strands.nodes.size()));
      const auto q = to_floats(p);
      out_.strands.nodes.push_back({q[0], q[1], q[2], float(s.root_radius * (1 - 0.75 * t * t))});
      out_.tint.push_back(tint);
      out_.along.push_back(float(t));
      direction = normalised(direction + s.bend * (1.0 / s.nodes));
      p += direction * (s.length / (s.nodes - 1));
      if (s.hug) p += field_.gradient(p) * (s.height * (1 - std::abs(2 * t - 1)) + 0.1 - field_.distance(p));
    }
  }

 private:
  const HeadField& field_;
  Random random_;
  HairStyle out_;
};

// Combed from the parting to the sides and back, with cowlicks.
Vec3 combed(const HeadTraits& t, Vec3 p, Vec3 n, Random& random) {
  const double part_x = 28 * t.hair_part;
  const double side = std::tanh((p.x - part_x) / 22);
  const Vec3 swirl{value_noise(p * 0.06, t.seed + 11), value_noise(p * 0.06, t.seed + 12),
                   value_noise(p * 0.06, t.seed + 13)};
  Vec3 flow{0.75 * side, -0.35 - 0.9 * smoothstep(60, 0, p.y), -0.85 * smoothstep(10, 60, p.y) - 0.25};
  flow += swirl * 0.7 + Vec3{random.normal(), random.normal(), random.normal()} * 0.16;
  return normalised(flow - n * dot(flow, n));
}

void grow_scalp(Grower& grower, const HeadField& field, const Mesh& skin, const std::vector<Vec3>& normals) {
  const HeadTraits& t = field.traits;
  Random& random = grower.random();
  constexpr double kPerMm2 = 1.1;
  for (const auto& corner : skin.triangles) {
    const Vec3 a = point_of(skin, corner[0]), b = point_of(skin, corner[1]), c = point_of(skin, corner[2]);
    if (a.z < -40 || a.y < -60 || scalp_hair(t, a) <= 0) continue;
    const double wanted = kPerMm2 * length(cross(b - a, c - a)) / 2;
    const int whole = int(wanted);
    const double rest = wanted - whole;  // how often there is one more
    for (int k = 0; k <= whole; ++k) {
      if (k == whole && (rest <= 0 || random.uniform() > rest)) break;
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 p = a + (b - a) * u + (c - a) * v, n = normals[corner[0]];
      const double grows = scalp_hair(t, p);
      if (random.uniform() > grows) continue;
      const double edge = smoothstep(0, 1, grows);
      const double length_mm = t.hair_length * random.uniform(0.6, 1.15) * mix(0.35, 1, edge) *
                               mix(0.45, 1.0, smoothstep(0, 55, p.y));
      const Vec3 flow = combed(t, p, n, random);
      grower.grow(p, {length_mm, random.uniform(0.035, 0.06), 0, flow + n * random.uniform(0.35, 1.0),
                      flow * 0.8 - n * 1.0 + Vec3{0, -0.25, 0}, 5, false});
    }
  }
}

void grow_brows(Grower& grower, const HeadField& field) {
  const HeadTraits& t = field.traits;
  Random& random = grower.random();
  const Brow brow = brow_of(t);
  const int count = int(620 * t.brow_density);
  for (int k = 0; k < 2 * count; ++k) {
    const double side = k % 2 == 0 ? 1 : -1, s = std::pow(random.uniform(), 0.9) * 1.04 - 0.02;
    const double across = random.normal_within(1.7) * 0.52;
    const double ax = mix(brow.inner, brow.outer, s),
                 y = brow.middle_y(s) + across * brow.half_height(s) - 0.5;
    Vec3 root{side * ax, y, field.skull.front_z(ax, y) + 2};
    for (int i = 0; i < 12; ++i) {  // on the skin
      const double d = field.distance(root);
      if (std::abs(d) < 0.02) break;
      root.z -= std::clamp(d, -4.0, 4.0) * 0.9;
    }
    // Upwards at the root of the nose, then outwards, the upper ones down and the lower ones up.
    const double lift = mix(1.5, -0.55, smoothstep(0.0, 0.75, s)) - 0.55 * across;
    const Vec3 direction{side * mix(0.35, 1, smoothstep(-0.05, 0.3, s)), lift * 0.6 + 0.16 * random.normal(),
                         -0.3 * s};
    grower.grow(root, {random.uniform(5, 9) * mix(1, 0.75, s),
                       random.uniform(0.04, 0.075),
                       random.uniform(0.25, 0.6),
                       direction,
                       {0.3 * side, -0.25, 0},
                       5,
                       true});
  }
}

void grow_lashes(Grower& grower, const HeadField& field) {
  Random& random = grower.random();
  for (int k = 0; k < 2 * 215; ++k) {
    const double side = k % 2 == 0 ? 1 : -1;
    const bool upper = k < 2 * 150;
    const double s = random.uniform(-0.82, 0.97);
    Vec3 root = field.eye.lid_point(s, upper);
    root.x *= side;
    root = root - (field.warped(root) - root) + Vec3{0, upper ? 0.1 : -0.1, -0.35};
    const Vec3 out{side * (0.55 * s + 0.12 * random.normal()), upper ? -0.15 : -0.35, 1};
    const Vec3 bend{side * 0.3 * s, upper ? 1.5 : -0.5, 0};
    grower.grow(root, {upper ? random.uniform(5.5, 8) * (0.75 + 0.25 * s) : random.uniform(2.5, 4.5),
                       random.uniform(0.045, 0.07), 0, out, bend, 5, false});
  }
}

}  // namespace

double scalp_hair(const HeadTraits& t, Vec3 p) {
  if (std::abs(p.x) > t.face_breadth / 2 + 3.5 && p.y < 24 && p.z < 12) return 0;  // the ear
  // Height of the hairline at each depth, from the nape round the ear to the forehead.
  static const Curve line{{-90, -75}, {-45, -70}, {-30, -40}, {-18, -4}, {-6, 22}, {3, 20},
                          {9, -4},    {14, -22},  {20, -12},  {27, 5},   {40, 24}, {52, 38},
                          {63, 52},   {76, 63},   {90, 71},   {100, 76}};
  const double lift = (t.hairline_y - 76) * smoothstep(45, 95, p.z);
  const double recede = 7 * t.age * t.masculine * gauss((std::abs(p.x) - 38) / 16) * smoothstep(60, 75, p.z);
  const double ragged = 3.2 * fractal_noise(p * 0.25, t.seed + 21, 2);
  return smoothstep(-4.0, 9.0, p.y - line(p.z) - lift - recede + ragged);
}

double brow_hair(const HeadField& field, Vec3 p) {
  const Brow brow = brow_of(field.traits);
  const double s = (std::abs(p.x) - brow.inner) / (brow.outer - brow.inner);
  if (s < -0.1 || s > 1.05 || p.z < 55) return 0;
  const double h = brow.half_height(s);
  return h > 0.1 ? gauss((p.y - brow.middle_y(s) - 0.5) / (h * 0.9)) * smoothstep(1.05, 0.8, s) : 0;
}

double beard_area(const HeadTraits& t, Vec3 p) {
  const double sto = stomion_y(t), sn = subnasale_y(t);
  const double jaw = smoothstep(sto + 16, sto - 6, p.y - 0.30 * (std::abs(p.x) - 30));
  const double moustache = bell(std::abs(p.x), 26, p.y - (sn + sto) / 2 - 1, 8.5);
  return clamp01(std::max(jaw, moustache)) * smoothstep(-25, 5, p.z) *
         smoothstep(gnathion_y(t) - 45, gnathion_y(t) - 15, p.y);
}

HairStyle grow_hair(const HeadField& field, const Mesh& skin, const std::vector<Vec3>& normals) {
  Grower grower(field, field.traits.seed * 3 + 1);
  grow_brows(grower, field);
  grow_lashes(grower, field);
  grow_scalp(grower, field, skin, normals);
  return grower.take();
}

}  // namespace relievo::hal::sim
