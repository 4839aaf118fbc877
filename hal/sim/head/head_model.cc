// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/head_model.h"

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

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

Vec3 sky_direction(Vec3 n, int i, int count, std::uint32_t hash) {
  const double turn = unit_from_hash(hash);
  const double r2 = (i + 0.5) / count, angle = 6.283185307179586 * (i * 0.6180339887498949 + turn);
  const Vec3 side = normalised(cross(std::abs(n.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n)),
             up = cross(n, side);
  const double r = std::sqrt(r2);
  return side * (r * std::cos(angle)) + up * (r * std::sin(angle)) + n * std::sqrt(1 - r2);
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
    pool.for_each_band(int(shell.mesh.points.size()), 64, [&](int begin, int end, int) {
      for (int i = begin; i < end; ++i) {
        const auto k = std::size_t(i);
        const Vec3 p = point_of(shell.mesh, k), n = shell.normals[k];
        if (p.z < -35) continue;  // no camera comes to see it
        int open = 0;
        for (int r = 0; r < kRays; ++r)
          open += caster.blocked(p + n * 0.12, sky_direction(n, r, kRays, hash_cell(i, r / kRays, 3, 5)),
                                 kReachMm)
                      ? 0
                      : 1;
        shell.openness[k] = float(open) / kRays;
      }
    });
    smooth_over(shell.mesh, shell.openness, 4);
  }
}

}  // namespace relievo::hal::sim
