// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render/face_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory_resource>
#include <queue>
#include <unordered_set>
#include <utility>

#include "hal/base/groups.h"
#include "pipeline/model/vector3.h"

namespace relievo::ui {
namespace {

using pipeline::Vec3d;
using pipeline::Vec3f;

// A face turns about the tip of its nose, a head, which is deeper, about its middle, and is seen whole.
constexpr float kHeadDepthMm = 130, kHeadShare = 0.8F;
constexpr float kNearMm = 200, kFarMm = 1200;

float side_mm(const Vec3f& a, const Vec3f& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

// How far along the ray a triangle is met (Moeller and Trumbore, 1997); infinite: not at all.
double met(const Vec3d& from, const Vec3d& along, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vec3d ab = minus(b, a), ac = minus(c, a), p = cross(along, ac);
  const double det = dot(ab, p);
  if (std::abs(det) < 1e-12) return kNever;
  const Vec3d s = minus(from, a), q = cross(s, ab);
  const double u = dot(s, p) / det, v = dot(along, q) / det, t = dot(ac, q) / det;
  return u < 0 || v < 0 || u + v > 1 || t <= 0 ? kNever : t;
}

constexpr float kMiddleBehindMm = 45;  // the head turns about a point behind the tip of its nose
constexpr float kFadeMm = 6;           // of the rim, into what stands behind

// How far from its border each vertex lies, in kFadeMm and no more than 1.
std::vector<float> within(const pipeline::FaceMesh& mesh) {
  const auto border = pipeline::border_vertices(mesh, std::pmr::get_default_resource());
  std::vector<float> share(border.size(), 1.0F);
  for (std::size_t v = 0; v < border.size(); ++v)
    if (border[v] != 0) share[v] = 0;
  const auto spread = [&](const std::array<std::uint32_t, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 1; j < 3; ++j) {
        const auto &a = mesh.vertices_mm[t[i]], &b = mesh.vertices_mm[t[(i + j) % 3]];
        if (share[t[i]] >= 1) continue;
        share[t[(i + j) % 3]] = std::min(share[t[(i + j) % 3]], share[t[i]] + side_mm(a, b) / kFadeMm);
      }
  };
  for (int pass = 0; pass < 2; ++pass) {
    std::ranges::for_each(mesh.triangles, spread);
    std::for_each(mesh.triangles.rbegin(), mesh.triangles.rend(), spread);
  }
  return share;
}

// Vertices of which no two are nearer to each other than `least_mm`, and none of the others farther from all.
std::vector<std::uint32_t> spaced(const pipeline::FaceMesh& mesh, float least_mm) {
  const auto cell = [least_mm](float v) { return std::int64_t(std::floor(v / least_mm)) + (1 << 20); };
  const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) { return (x << 42) | (y << 21) | z; };
  std::unordered_multimap<std::int64_t, std::uint32_t> held;
  std::vector<std::uint32_t> chosen;
  const auto crowded = [&](const Vec3f& at) {
    const std::int64_t x = cell(at.x), y = cell(at.y), z = cell(at.z);
    for (std::int64_t k = 0; k < 27; ++k) {
      const auto [from, to] = held.equal_range(key(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1));
      if (std::any_of(from, to, [&](const auto& entry) {
            return side_mm(mesh.vertices_mm[entry.second], at) < least_mm;
          }))
        return true;
    }
    return false;
  };
  for (std::uint32_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3f& at = mesh.vertices_mm[v];
    if (crowded(at)) continue;
    held.emplace(key(cell(at.x), cell(at.y), cell(at.z)), v);
    chosen.push_back(v);
  }
  return chosen;
}

// The neighbours of every vertex, one list after the other; each twice where two triangles share the side.
Groups neighbours_of(const pipeline::FaceMesh& mesh) {
  Groups neighbours;
  neighbours.sort(mesh.vertices_mm.size(), [&](auto&& add) {
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 1; j < 3; ++j) add(t[i], t[(i + j) % 3]);
  });
  return neighbours;
}

// The chosen vertex that is nearest to each along the mesh.
std::vector<std::uint32_t> nearest(const pipeline::FaceMesh& mesh, const std::vector<std::uint32_t>& chosen) {
  const Groups neighbours = neighbours_of(mesh);
  const std::size_t count = mesh.vertices_mm.size();
  std::vector<std::uint32_t> owner(count);
  std::vector<float> far(count, HUGE_VALF);
  using Reached = std::pair<float, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (const std::uint32_t v : chosen) {
    owner[v] = v;
    far[v] = 0;
    queue.emplace(0.0F, v);
  }
  while (!queue.empty()) {
    const auto [so_far, v] = queue.top();
    queue.pop();
    if (so_far > far[v]) continue;
    for (const std::uint32_t to : neighbours[v]) {
      const float reached = so_far + side_mm(mesh.vertices_mm[v], mesh.vertices_mm[to]);
      if (reached >= far[to]) continue;
      far[to] = reached;
      owner[to] = owner[v];
      queue.emplace(reached, to);
    }
  }
  for (std::uint32_t v = 0; v < count; ++v)
    if (far[v] == HUGE_VALF) owner[v] = v;  // a piece of the mesh that is smaller than the spacing
  return owner;
}

}  // namespace

FaceStand stand_of(const pipeline::FaceModel& model) {
  constexpr float kEnd = std::numeric_limits<float>::max();
  float low = kEnd, high = -kEnd, back = kEnd, front = -kEnd;
  for (const auto& triangle : model.mesh.triangles)
    for (const std::uint32_t at : triangle) {
      const Dot d = dot_of(model.head_from_camera, model.mesh.vertices_mm[at]);
      low = std::min(low, d.y), high = std::max(high, d.y);
      back = std::min(back, d.z), front = std::max(front, d.z);
    }
  if (low > high) return {};
  FaceStand stand{(low + high) / 2, 0, 1};
  if (front - back <= kHeadDepthMm) return stand;
  stand.axis_mm = (back + front) / 2;
  stand.fit = std::min(1.0F, kHeadShare * kSeenHeightMm / (high - low));
  return stand;
}

// First about the upright axis, then about the level one.
FaceProjection::FaceProjection(const FaceStand& stand, const FaceLook& look, float aspect, float covered)
    : scale_(2 * kFaceDistanceMm / kSeenHeightMm * look.zoom * stand.fit),
      aspect_(aspect),
      covered_(covered) {
  const float cy = std::cos(radians(look.yaw_deg)), sy = std::sin(radians(look.yaw_deg));
  const float cp = std::cos(radians(look.pitch_deg)), sp = std::sin(radians(look.pitch_deg));
  const float from[] = {cy, sp * sy, -cp * sy, 0, cp, sp, sy, -sp * cy, cp * cy};
  std::copy(std::begin(from), std::end(from), turned_);
  const float cr = std::cos(radians(look.roll_deg)), sr = std::sin(radians(look.roll_deg));
  for (std::size_t c = 0; c < 9; c += 3) {
    const float across = turned_[c], up = turned_[c + 1];
    turned_[c] = cr * across + sr * up;
    turned_[c + 1] = cr * up - sr * across;
  }
  // What turning about the axis moves the origin by; the middle of the model is the window's.
  shift_[0] = -stand.axis_mm * turned_[6];
  shift_[1] = -stand.axis_mm * turned_[7] - stand.middle_mm;
  shift_[2] = stand.axis_mm * (1 - turned_[8]);
  const float f = scale_, a = (kFarMm + kNearMm) / (kNearMm - kFarMm),
              b = 2 * kFarMm * kNearMm / (kNearMm - kFarMm);
  for (std::size_t c = 0; c < 3; ++c) {
    clip_[4 * c] = f / aspect * turned_[3 * c];
    clip_[4 * c + 1] = f * turned_[3 * c + 1];
    clip_[4 * c + 2] = a * turned_[3 * c + 2];
    clip_[4 * c + 3] = -turned_[3 * c + 2];
  }
  clip_[12] = f / aspect * shift_[0];
  clip_[13] = f * shift_[1];
  clip_[14] = a * (shift_[2] - kFaceDistanceMm) + b;
  clip_[15] = kFaceDistanceMm - shift_[2];
  for (std::size_t c = 0; c < 4; ++c)
    clip_[4 * c + 1] += covered_ * clip_[4 * c + 3];  // half the window is 1
}

pipeline::Vec2f FaceProjection::seen(const pipeline::Vec3f& at) const {
  float out[4];
  for (std::size_t r = 0; r < 4; ++r)
    out[r] = clip_[r] * at.x + clip_[4 + r] * at.y + clip_[8 + r] * at.z + clip_[12 + r];
  return {(1 + out[0] / out[3]) / 2, (1 - out[1] / out[3]) / 2};
}

std::optional<pipeline::Vec3f> FaceProjection::touched(const pipeline::FaceModel& model,
                                                       pipeline::Vec2f window) const {
  const auto turned_back = [this](const Vec3d& v) {
    const auto of = [&](std::size_t i) {
      return double(turned_[3 * i]) * v.x + double(turned_[3 * i + 1]) * v.y +
             double(turned_[3 * i + 2]) * v.z;
    };
    return Vec3d{of(0), of(1), of(2)};
  };
  const double across = double((2 * window.x - 1) * aspect_ / scale_),
               up = double((1 - 2 * window.y - covered_) / scale_);
  const Vec3d from =
                  turned_back({-double(shift_[0]), -double(shift_[1]), double(kFaceDistanceMm - shift_[2])}),
              along = turned_back({across, up, -1});
  const auto corner = [&](std::uint32_t at) {
    return pipeline::wide(dot_of(model.head_from_camera, model.mesh.vertices_mm[at]));
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : model.mesh.triangles)
    nearest = std::min(nearest, met(from, along, corner(t[0]), corner(t[1]), corner(t[2])));
  if (std::isinf(nearest)) return std::nullopt;
  return pipeline::narrow(pipeline::along(from, nearest, along));
}

Dot dot_of(const pipeline::RigidTransform& t, const pipeline::Vec3f& v) {
  const auto p = apply(t, pipeline::Vec3d{v.x, v.y, v.z});
  return {float(p.x), float(p.y), float(p.z) + kMiddleBehindMm};
}

std::vector<Dot> dots_of(const pipeline::FaceModel& model, const pipeline::PointCloud* cloud) {
  std::vector<Dot> dots;
  if (cloud == nullptr)
    for (const auto& v : model.mesh.vertices_mm) dots.push_back(dot_of(model.head_from_camera, v));
  else
    for (const auto& p : cloud->points) dots.push_back(dot_of(model.head_from_camera, p.at_mm));
  return dots;
}

std::size_t set_apart(std::vector<Dot>& dots) {
  constexpr long kAcross = 1 << 12;
  std::unordered_set<long> taken;
  const auto first_in_its_cube = [&](const Dot& d) {
    const auto at = [](float mm) { return std::lround(mm / kApartMm); };
    return taken.insert((at(d.x) * kAcross + at(d.y)) * kAcross + at(d.z)).second;
  };
  return std::size_t(std::stable_partition(dots.begin(), dots.end(), first_in_its_cube) - dots.begin());
}

std::vector<Tinted> tinted_of(const pipeline::FaceModel& model) {
  const pipeline::Backdrop& b = model.backdrop;
  std::vector<Tinted> corners;
  const auto corner = [&](int c, int r) {
    const std::size_t k = std::size_t(r) * std::size_t(b.columns) + std::size_t(c);
    const Dot d = dot_of(model.head_from_camera, b.at_mm[k]);
    return Tinted{d.x, d.y, d.z, b.rgba[k]};
  };
  for (int r = 0; r + 1 < b.rows; ++r)
    for (int c = 0; c + 1 < b.columns; ++c) {
      const Tinted p = corner(c, r), q = corner(c + 1, r), o = corner(c, r + 1), d = corner(c + 1, r + 1);
      if ((p.rgba[3] | q.rgba[3] | o.rgba[3] | d.rgba[3]) != 0)
        corners.insert(corners.end(), {p, o, d, p, d, q});
    }
  return corners;
}

std::vector<Corner> corners_of(const pipeline::FaceModel& model, const pipeline::SeamSplit& split) {
  const auto& t = model.head_from_camera;
  const std::vector<float> share = within(model.mesh);
  std::vector<Corner> corners;
  corners.reserve(split.entries.size());
  for (const auto& [at, uv] : split.entries) {
    const Dot p = dot_of(t, model.mesh.vertices_mm[at]);
    const auto& n = model.mesh.normals[at];
    const auto m = apply(t.rotation, pipeline::Vec3d{n.x, n.y, n.z});
    corners.push_back({p.x, p.y, p.z, float(m.x), float(m.y), float(m.z), uv.x, uv.y, share[at]});
  }
  return corners;
}

Edges edges_of(const pipeline::FaceMesh& mesh, float least_mm) {
  const std::vector<std::uint32_t> owner = nearest(mesh, spaced(mesh, least_mm));
  Edges edges;
  for (const auto& t : mesh.triangles) {
    const std::uint32_t a = owner[t[0]], b = owner[t[1]], c = owner[t[2]];
    if (a == b || b == c || c == a) continue;
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
      edges.push_back({std::min(p, q), std::max(p, q)});
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace relievo::ui
