// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/head_model.h"

#include <array>

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

double blood(const HeadField& f, Vec3 q) {
  const double ax = std::abs(q.x);
  const Vec3 tip = f.nose.tip();
  double b = 0.55 * bell({ax - 38, q.y + 30, q.z - 88}, {17, 15, 30}) + 0.65 * bell(q - tip, {15, 12, 16});
  b += 0.45 * smoothstep(66, 76, ax) +
       0.22 * bell({ax, q.y - gnathion_y(f.traits) - 14, q.z - 100}, {20, 14, 20});
  b += 0.30 * bell(ax - f.eye.centre().x, 17, q.y - 2, 9) * (q.z > 60 ? 1 : 0);
  return b + 0.42 * fractal_noise(q * (1 / 9.0), f.traits.seed + 31, 4);
}

// Darkening: under the eyes, blotches, freckles, moles.
double melanin(const HeadField& f, Vec3 p, Vec3 q) {
  const double ax = std::abs(q.x);
  double m = 0.10 * bell(ax - f.eye.centre().x + 4, 13, q.y + 11, 5.5) * (q.z > 60 ? 1 : 0);
  m += 0.08 * bell(ax - 13, 6, q.y, 9) * (q.z > 60 ? 1 : 0);
  m += 0.08 * value_noise(p * (1 / 18.0), f.traits.seed) +
       0.05 * value_noise(p * (1 / 6.0), f.traits.seed + 1);
  m += 0.045 * value_noise(p * (1 / 2.2), f.traits.seed + 2) +
       0.035 * value_noise(p * (1 / 0.9), f.traits.seed + 3);
  const NearestDot spot = nearest_dot(p * (1 / 2.4), f.traits.seed + 4);
  const double chosen = unit_from_hash(spot.hash * 2654435761U);
  const double zone = 0.35 + 0.65 * gauss((q.y + 18) / 30);
  if (chosen < 0.65 * f.traits.freckles * zone)
    m += 0.20 * (0.4 + chosen) * smoothstep(0.30, 0.12, spot.distance);
  const NearestDot mole = nearest_dot(p * (1 / 30.0), f.traits.seed + 5);
  const double size = 0.35 + 1.1 * unit_from_hash(mole.hash * 747796405U);
  m += 0.9 * smoothstep(size, size * 0.55, mole.distance * 30 + 0.25 * value_noise(p * 2, 9));
  return m;
}

// The skin's own colour: blood and melanin in it, pores and a beard's stubble on it.
Vec3 complexion(const HeadField& f, Vec3 p, Vec3 q, double dark) {
  Vec3 c = f.traits.skin;
  const double red = std::max(0.0, blood(f, q)) * 0.6;
  c = c * mix(Vec3{1, 1, 1}, Vec3{1.02, 0.74, 0.74}, red);
  const auto absorb = [&](double power) { return std::exp(-dark * power); };
  c = c * Vec3{absorb(0.85), absorb(1.1), absorb(1.35)};
  const double pores = smoothstep(80, 95, q.z) * 0.7 + 0.5;
  const NearestDot pore = nearest_dot(p * (1 / 1.05), f.traits.seed + 6);
  c = c * (1 - 0.15 * pores * smoothstep(0.30, 0.05, pore.distance));
  const double beard = beard_area(f.traits, q) * f.traits.stubble;
  if (beard > 0.02) {
    const double stubble = smoothstep(0.36, 0.16, nearest_dot(p * (1 / 0.85), f.traits.seed + 7).distance);
    c = mix(c, c * Vec3{0.80, 0.84, 0.88}, beard * 0.8);
    c = mix(c, f.traits.hair * 0.8 + c * 0.2, beard * 0.55 * stubble);
  }
  return c;
}

// Inside the lids' edge it is wet and pink; roots of the lashes draw a dark line.
Vec3 with_lid(const HeadField& f, Vec3 c, Vec3 q) {
  const double eye_s = f.eye.along(std::abs(q.x));
  if (std::abs(eye_s) >= 1.05 || q.z <= 70) return c;
  const double edge = std::max(q.y - f.eye.upper_lid(eye_s), f.eye.lower_lid(eye_s) - q.y);
  c = mix(c, c * Vec3{0.95, 0.62, 0.60}, smoothstep(0.75, 0.2, edge));
  c = mix(c, c * 0.35 + f.traits.hair * 0.3,
          (q.y > -1 ? 0.75 : 0.35) * gauss((edge - 0.75) / 0.6) * smoothstep(1.02, 0.8, std::abs(eye_s)));
  return c * (1 - 0.16 * smoothstep(6, 1, edge));
}

double skin_height(const HeadField& f, Vec3 p, double lip, double coarse) {
  const NearestDot pore = nearest_dot(p * (1 / 1.05), f.traits.seed + 6);
  double h = -0.040 * coarse * smoothstep(0.34, 0.05, pore.distance);
  h += 0.028 * value_noise(p * (1 / 1.3), f.traits.seed + 51) +
       0.010 * value_noise(p * (1 / 0.5), f.traits.seed + 52);
  if (lip > 0) h = mix(h, 0.03 * value_noise({p.x * 1.1, p.y * 0.25, p.z * 0.25}, f.traits.seed + 8), lip);
  return h;
}

// Cosine-weighted directions about a normal, stratified; turned by the hash.
Vec3 sky_direction(Vec3 n, int i, int count, std::uint32_t hash) {
  const double turn = unit_from_hash(hash);
  const double r2 = (i + 0.5) / count, angle = 6.283185307179586 * (i * 0.6180339887498949 + turn);
  const Vec3 side = normalised(cross(std::abs(n.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n)),
             up = cross(n, side);
  const double r = std::sqrt(r2);
  return side * (r * std::cos(angle)) + up * (r * std::sin(angle)) + n * std::sqrt(1 - r2);
}

// The surface of an ellipsoid.
void append_ball(Mesh& mesh, Vec3 centre, Vec3 radii) {
  constexpr std::uint32_t kRings = 60, kSpokes = 120;
  const auto base = std::uint32_t(mesh.points.size());
  for (std::uint32_t i = 0; i <= kRings; ++i)
    for (std::uint32_t j = 0; j < kSpokes; ++j) {
      // Poles left and right: the pupil lies where the net is even.
      const double a = i * 3.141592653589793 / kRings, b = j * 6.283185307179586 / kSpokes;
      mesh.points.push_back(
          to_floats(centre + Vec3{radii.x * std::cos(a), radii.y * std::sin(a) * std::sin(b),
                                  radii.z * std::sin(a) * std::cos(b)}));
    }
  for (std::uint32_t i = 0; i < kRings; ++i)
    for (std::uint32_t j = 0; j < kSpokes; ++j) {
      const std::uint32_t p = base + i * kSpokes + j, q = base + i * kSpokes + (j + 1) % kSpokes;
      mesh.triangles.push_back({p, q, p + kSpokes});
      mesh.triangles.push_back({q, q + kSpokes, p + kSpokes});
    }
}

}  // namespace

Surface skin_look(const HeadField& f, Vec3 p) {
  const Vec3 q = f.warped(p);
  Surface s;
  const double dark = melanin(f, p, q);
  Vec3 c = complexion(f, p, q, dark);
  const double lip = f.mouth.vermilion(q);
  if (lip > 0) {
    const double crease = value_noise({q.x * 1.5, q.y * 0.25, q.z * 0.25}, f.traits.seed + 8);
    const Vec3 tone = f.traits.skin * mix(Vec3{0.82, 0.56, 0.57}, Vec3{0.80, 0.70, 0.72},
                                          smoothstep(0.35, 0.1, f.traits.skin.x));
    c = mix(c, tone * (1 + 0.10 * crease) * std::exp(-0.5 * dark), lip * 0.85);
  }
  const Vec3 leaning = f.swayed(p);
  if (f.traits.expression.jaw_mm > 0 && leaning.z < f.mouth.front() - 3 &&
      f.mouth.gape(leaning) < 1.5) {  // lining of the cheeks and the palate
    c = Vec3{0.34, 0.12, 0.11};
    s.gloss = 0.6, s.colour = c, s.roughness = 0.4, s.translucent = 1;
    return s;
  }
  const double line =
      q.z > 75 && std::abs(q.x) < f.mouth.half_width() + 1 ? gauss((q.y - f.mouth.line_y(q.x)) / 0.55) : 0;
  c = c * (1 - 0.6 * line);
  const double scalp = scalp_hair(f.traits, p), brow = brow_hair(f, q);
  c = mix(c, f.traits.hair * 1.1 + c * 0.12, 0.85 * smoothstep(0.15, 1.0, scalp));
  c = mix(c, f.traits.hair + c * 0.3, 0.30 * brow * f.traits.brow_density);
  s.colour = with_lid(f, c, q);
  const double oily = 0.5 + 0.5 * bell(q.x, 26, q.y - 40, 28) + 0.7 * bell(q.x, 12, q.y + 20, 26) +
                      0.25 * value_noise(q * 0.12, f.traits.seed + 41);
  s.gloss = mix(0.78 * oily * mix(0.7, 1, smoothstep(0.1, 0.4, f.traits.skin.x)), 0.5, lip) *
            (1 - 0.8 * scalp) * (0.8 + 0.4 * unit_from_hash(hash_cell(7, 7, 7, f.traits.seed))) *
            f.traits.shine;
  s.roughness = mix(0.48, 0.42, lip);
  s.translucent = 1;
  return s;
}

Vec3 skin_slope(const HeadField& f, Vec3 p) {
  constexpr double e = 0.12;
  const double lip = f.mouth.vermilion(p), coarse = 0.5 + 0.7 * smoothstep(80, 95, p.z);
  const double h = skin_height(f, p, lip, coarse);
  return Vec3{skin_height(f, p + Vec3{e, 0, 0}, lip, coarse) - h,
              skin_height(f, p + Vec3{0, e, 0}, lip, coarse) - h,
              skin_height(f, p + Vec3{0, 0, e}, lip, coarse) - h} *
         (1 / e);
}

EyeLook eye_look(const HeadTraits& t, Vec3 from, Vec3 gaze) {
  const Vec3 n = normalised(from);
  const double off =
      std::acos(std::clamp(dot(n, gaze), -1.0, 1.0)) * 12.0;  // mm along the ball from the pupil
  EyeLook look;
  look.normal = n;
  Surface& s = look.surface;
  s.gloss = 3.0;
  s.roughness = 0.12;
  const Vec3 side = n - gaze * dot(n, gaze);
  const double spoke = std::atan2(side.y, side.x);
  const double veins = smoothstep(
      0.55, 0.9, value_noise({spoke * 5, off * 0.35, value_noise(n * 9, t.seed + 62) * 1.5}, t.seed + 61));
  const Vec3 sclera = Vec3{0.52, 0.475, 0.445} * (1 - 0.03 * t.age) -
                      Vec3{0, 0.10, 0.10} * (veins * smoothstep(6.5, 11, off)) -
                      Vec3{0.0, 0.05, 0.06} * smoothstep(8, 14, off);
  const double fibres = 0.55 * value_noise({spoke * 9, off * 0.5, 1}, t.seed + 63) +
                        0.45 * value_noise({spoke * 22, off * 0.9, 2}, t.seed + 64);
  Vec3 iris = t.iris * (1.0 + 0.45 * fibres);
  iris = mix(iris, iris * Vec3{1.5, 1.1, 0.7}, 0.5 * smoothstep(3.4, 2.2, off));
  iris = iris * mix(1, 0.30, smoothstep(4.7, 5.9, off));  // the dark ring
  const Vec3 pupil{0.006, 0.006, 0.006};
  s.colour = mix(mix(pupil, iris, smoothstep(1.75, 2.05, off)), sclera, smoothstep(5.6, 6.3, off));
  // The cornea is a smaller sphere set forward: its normals lean outwards more.
  const double bulge = smoothstep(6.4, 5.2, off);
  look.normal = normalised(n + normalised(side + Vec3{1e-9, 0, 0}) * (bulge * 0.5 * off / 12.0));
  return look;
}

Surface teeth_look(Vec3 p) {
  constexpr std::array<double, 4> kEdge{0, 8.5, 15, 22.5};  // central and lateral incisors, canines
  double gap = 0;
  for (const double x : kEdge) gap = std::max(gap, gauss((std::abs(p.x) - x) / 0.35));
  return {Vec3{0.62, 0.58, 0.49} * (1 - 0.55 * gap), 1.6, 0.22, 0.3};
}

Surface tongue_look(const HeadTraits& t, Vec3 p) {
  const NearestDot papilla = nearest_dot(p * (1 / 1.4), t.seed + 81);
  const double furrow = gauss(p.x / 1.2);
  return {Vec3{0.50, 0.26, 0.25} * (1 - 0.15 * furrow + 0.18 * smoothstep(0.45, 0.1, papilla.distance)), 0.9,
          0.32, 0.8};
}

Surface shirt_look(const HeadTraits& t, Vec3 p) {
  static constexpr std::array<Vec3, 6> kColours{Vec3{0.05, 0.06, 0.09}, {0.35, 0.36, 0.38},
                                                {0.12, 0.17, 0.30},     {0.30, 0.07, 0.08},
                                                {0.10, 0.17, 0.12},     {0.55, 0.53, 0.50}};
  const double weave = 0.12 * std::sin(p.x * 5.2 + 0.3 * std::sin(p.z)) * std::sin((p.y + p.z) * 5.2) +
                       0.10 * value_noise(p * 1.1, t.seed + 71);
  return {kColours[std::size_t(t.shirt) % kColours.size()] * (1 + weave), 0.15, 0.7, 0};
}

void smooth_over(const Mesh& mesh, std::vector<float>& values, int times) {
  std::vector<float> sum(values.size()), weight(values.size());
  for (int k = 0; k < times; ++k) {
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] = 2 * values[i], weight[i] = 2;
    for (const auto& t : mesh.triangles)
      for (std::size_t c = 0; c < 3; ++c) {
        sum[t[c]] += values[t[(c + 1) % 3]] + values[t[(c + 2) % 3]];
        weight[t[c]] += 2;
      }
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = sum[i] / weight[i];
  }
}

HeadModel::HeadModel(const HeadTraits& t, ThreadPool& pool) : traits(t), field(t) {
  build_skin(pool);
  build_eyes();
  build_shirt(pool);
  build_mouth(pool);
  for (Shell& shell : shells) {
    if (shell.mesh.triangles.empty()) continue;  // the last ones only, so that bodies keep their numbers
    shell.normals = smooth_normals(shell.mesh);
    caster.add(shell.mesh);
  }
  hair = grow_hair(field, shells[Skin].mesh, shells[Skin].normals);
  caster.add(hair.strands);
  caster.commit();
  measure_openness(pool);
}

// A millimetre and a quarter all over, half of that on the face, a quarter where lids, lips and
// nostrils bend.
void HeadModel::build_skin(ThreadPool& pool) {
  const Field at = [this](Vec3 p) { return field.distance(p); };
  const double gn = gnathion_y(traits), sto = stomion_y(traits);
  const double eye_x = std::abs(field.eye.centre().x);
  Mesh& mesh = shells[Skin].mesh;
  mesh = mesh_of_field(at, {{-98, gn - 75, -70}, {98, 125, 140}}, 1.25, pool);
  refine(
      mesh, at,
      [&](Vec3 p) {
        return (p.z > 55 && p.y < 48 && p.y > gn - 12 - traits.expression.jaw_mm) ||
               std::abs(p.x) > traits.face_breadth / 2 + 2;
      },
      pool);
  refine(
      mesh, at,
      [&](Vec3 p) {
        const double ax = std::abs(p.x);
        const bool eye = std::abs(ax - eye_x) < 22 && std::abs(p.y) < 15,
                   nose = ax < 24 && p.y < -20 && p.y > subnasale_y(traits) - 6;
        return p.z > 68 && (eye || nose ||
                            (ax < field.mouth.half_width() + 5 && p.y < sto + 14 &&
                             p.y > sto - 14 - traits.expression.jaw_mm));
      },
      pool);
}

void HeadModel::build_eyes() {
  const Vec3 c = field.eye.centre();
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 wanted{side == 0 ? c.x : -c.x, c.y, c.z};
    eye_centres[side] = wanted - (field.warped(wanted) - wanted);
    const double r = field.eye.radius();
    append_ball(shells[Eyes].mesh, eye_centres[side], {r, r, r});
    // What lies behind the corners: the caruncle towards the nose, the conjunctiva outside.
    const double inwards = side == 0 ? -1 : 1;
    append_ball(shells[Inner].mesh, eye_centres[side] + Vec3{0.2 * inwards, -0.4, -1.6},
                {r + 3.6, r * 0.8, r - 0.6});
    append_ball(shells[Inner].mesh,
                eye_centres[side] + Vec3{inwards * (traits.eye_fissure / 2 - 1.1), -1.4, 5.2},
                {2.5, 1.9, 2.6});
  }
}

void HeadModel::build_shirt(ThreadPool& pool) {
  const double gn = gnathion_y(traits);
  const Field cloth = [&](Vec3 p) {
    const double folds = 1.2 * fractal_noise({p.x / 30, p.y / 55, p.z / 30}, traits.seed + 77, 2);
    const double collar = p.y - (gn - 50 - 0.5 * p.z) - 1.5 * std::sin(p.x * 0.03);
    const double inside = field.skull.distance(p) - 3.2 - folds;
    const double ring = std::abs(collar + 6) - 5.5;  // a thicker band at the neck
    return cut(inside - (ring < 0 ? 0.9 : 0.0), collar, 2.0);
  };
  shells[Shirt].mesh = mesh_of_field(cloth, {{-230, gn - 190, -110}, {230, gn + 10, 75}}, 3.0, pool);
}

// The upper teeth stay, the lower ones and the tongue go with the jaw.
void HeadModel::build_mouth(ThreadPool& pool) {
  const double jaw = traits.expression.jaw_mm, out = traits.expression.tongue_mm;
  if (jaw <= 0) return;
  const double sto = stomion_y(traits), front = field.mouth.front();
  const double shown = 2.2 + std::min(5.5 * traits.expression.smile,
                                      std::max(0.0, jaw - 3));  // a smile lifts the lip off the upper ones
  const auto arch = [](double x) { return -0.022 * x * x; };    // 14 mm back at the molars
  const auto row = [&](Vec3 p, double low, double high, double z) {
    return std::max({std::abs(p.x) - 25, std::abs(p.z - z - arch(p.x)) - 2.4, low - p.y, p.y - high});
  };
  const Field teeth = [&](Vec3 p) {
    const Vec3 q = field.swayed(p);
    return std::min(row(q, sto - shown, sto + 8, front - 4.5),
                    row(q, sto - jaw - 9, sto - jaw - 1, front - 6.5));
  };
  const Box box{{-30, sto - jaw - 12, front - 30}, {30, sto + 11, front + 4}};
  shells[Teeth].mesh = mesh_of_field(teeth, box, 0.8, pool);
  // Wider than thick by 2.3; put out, it lies on the lower lip and hangs over it.
  const double floor = sto - jaw - (out > 0 ? 0 : 4);
  const BeadString body({{{0, floor - 6, front - 34}, 8.5},
                         {{0, floor + 1.5, front - 9}, 7.0},
                         {{0, floor + 1, front + 0.45 * out}, 6.0},
                         {{0, floor - 0.75 * out, front + 0.8 * out}, 4.2}},
                        4);
  const BeadString still({{{0, floor - 6, front - 34}, 8.5}, {{0, floor, front - 14}, 6.5}}, 3);
  const Field tongue = [&](Vec3 p) {
    const Vec3 q = field.swayed(p), thick{q.x / 2.3, q.y, q.z};
    return out > 0 ? body.distance(thick) : still.distance(thick);
  };
  shells[Tongue].mesh = mesh_of_field(
      tongue, {{-26, floor - 30 - out, front - 50}, {26, floor + 16, front + 14 + out}}, 1.2, pool);
}

void HeadModel::measure_openness(ThreadPool& pool) {
  constexpr int kRays = 10;
  constexpr double kReachMm = 90;
  for (Shell& shell : shells) {
    if (shell.mesh.points.empty()) continue;
    shell.openness.assign(shell.mesh.points.size(), 0.8F);
    pool.for_each(int(shell.mesh.points.size()), 64, [&](int i) {
      const auto k = std::size_t(i);
      const Vec3 p = point_of(shell.mesh, k), n = shell.normals[k];
      if (p.z < -35) return;  // no camera comes to see it
      int open = 0;
      for (int r = 0; r < kRays; ++r)
        open +=
            caster.blocked(p + n * 0.12, sky_direction(n, r, kRays, hash_cell(i, r / kRays, 3, 5)), kReachMm)
                ? 0
                : 1;
      shell.openness[k] = float(open) / kRays;
    });
    smooth_over(shell.mesh, shell.openness, 4);
  }
}

}  // namespace relievo::hal::sim
