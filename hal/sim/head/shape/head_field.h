// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadField: the head as an implicit surface, sculpted in code from HeadTraits: a skull and jaw
// lofted from measured breadths and depths, with nose, lips, lids, ears and neck blended in.
// Frame and units: head_traits.h. Thread: any, once built.
#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/sim/base/noise.h"
#include "hal/sim/base/vec3.h"
#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {

// The sculptor's tools: distances to simple bodies and ways to blend them. A field is negative
// inside; values near the surface are distances in mm, further off only their sign can be trusted.
// Unions and cuts that round the seam over a width of about k (cubic blend, I. Quilez).
inline double join(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}
inline double cut(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::max(a, b) + h * h * h * k / 6;
}

inline double ellipsoid(Vec3 p, Vec3 radii) {
  const Vec3 a{p.x / radii.x, p.y / radii.y, p.z / radii.z};
  const Vec3 b{a.x / radii.x, a.y / radii.y, a.z / radii.z};
  const double k0 = length(a), k1 = length(b);
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

struct Bead {
  Vec3 at;
  double radius = 0;
};
// A capsule whose radius changes linearly.
inline double tapered(Vec3 p, const Bead& a, const Bead& b) {
  const Vec3 along = b.at - a.at, from = p - a.at;
  const double t = clamp01(dot(from, along) / dot(along, along));
  return length(from - along * t) - mix(a.radius, b.radius, t);
}

// Bell of height 1: exp(-(d/width)^2) in each direction.
inline double bell(double dx, double wx, double dy, double wy) {
  const double q = (dx / wx) * (dx / wx) + (dy / wy) * (dy / wy);
  return q > 9 ? 0 : std::exp(-q);
}
inline double bell(Vec3 d, Vec3 w) {
  const double q = (d.x / w.x) * (d.x / w.x) + (d.y / w.y) * (d.y / w.y) + (d.z / w.z) * (d.z / w.z);
  return q > 9 ? 0 : std::exp(-q);
}

// A smooth curve through points with rising x; constant slope outside.
class Curve {
 public:
  struct Knot {
    double x, y;
  };
  Curve() = default;
  Curve(std::initializer_list<Knot> knots);
  double operator()(double x) const;

 private:
  std::vector<Knot> knots_;
  std::vector<double> slopes_;
};

// A string of beads, smoothly threaded: the distance to the thickest neighbourhood of it.
class BeadString {
 public:
  BeadString() = default;
  BeadString(std::initializer_list<Bead> beads, int pieces_between);
  double distance(Vec3 p) const;

 private:
  std::vector<Bead> beads_;
};

// Skull, jaw and neck, and the depth of the face where nothing has been added yet.
class SkullForm {
 public:
  explicit SkullForm(const HeadTraits& traits);
  double distance(Vec3 p) const;
  double front_z(double x, double y) const;  // of the plain face, without strokes
 private:
  double loft(Vec3 p) const;
  double neck(Vec3 p) const;
  HeadTraits t_;
  Curve breadth_, front_, widest_z_, roundness_;
};

// Muscle, fat and creases: heights in mm to be added along the normal.
double stroke_height(const HeadTraits& traits, Vec3 p);

class NoseForm {
 public:
  NoseForm(const HeadTraits& traits, const SkullForm& skull);
  double add_to(double field, Vec3 p) const;
  Vec3 tip() const { return tip_; }

 private:
  HeadTraits t_;
  double sn_y_, sn_z_;
  Vec3 tip_, ala_;
  std::array<Bead, 3> bridge_;
  std::array<Bead, 2> wall_;
  Mat3 wing_turn_, nostril_turn_;
};

class MouthForm {
 public:
  MouthForm(const HeadTraits& traits, const SkullForm& skull);
  double add_to(double field, Vec3 p) const;
  double vermilion(Vec3 p) const;     // 1 on the lips, 0 on the skin
  double line_y(double x) const;      // where the lips meet
  double upper_edge(double x) const;  // of the vermilion
  double lower_edge(double x) const;
  double half_width() const { return half_width_; }
  // An open mouth is a closed one whose lower lip, and the jaw with it, were moved down: where in the closed
  // mouth a point was. Points between the lips were on the line where they meet.
  Vec3 closed(Vec3 p) const;
  double gape(Vec3 p) const;  // negative between parted lips; asked where the point is, not where it was
  double front() const { return front_; }

 private:
  double dropped(double x, double z) const;  // the lower lip, mm
  HeadTraits t_;
  double half_width_, sto_, upper_mm_, lower_mm_;
  BeadString upper_, lower_, line_;
  Curve bow_;
  double front_;
};

class EyeForm {
 public:
  EyeForm(const HeadTraits& traits, const SkullForm& skull);
  double add_to(double field, Vec3 p) const;
  Vec3 centre() const { return centre_; }  // of the person's left eyeball
  double radius() const { return 12.0; }
  // -1 inner corner, 1 outer corner.
  double along(double ax) const { return (ax - middle_x_) / half_fissure_; }
  double upper_lid(double s) const;
  double lower_lid(double s) const;
  Vec3 lid_point(double s, bool upper) const;  // on the lid's edge

 private:
  double raised_lid(double s) const;  // the upper lid's edge when the eye is open
  HeadTraits t_;
  Vec3 centre_;
  double middle_x_, half_fissure_;
};

class EarForm {
 public:
  explicit EarForm(const HeadTraits& traits);
  double add_to(double field, Vec3 p) const;

 private:
  Vec3 local(Vec3 p) const;
  Vec3 root_;
  Mat3 turn_;
  double size_;
  BeadString helix_, antihelix_;
};

struct HeadField {
  explicit HeadField(const HeadTraits& t) : traits(t) {}
  double distance(Vec3 p) const;
  Vec3 gradient(Vec3 p) const;  // normalised; outward
  Vec3 swayed(Vec3 p) const;    // faces lean: where in the upright one a point was
  Vec3 warped(Vec3 p) const;    // where the symmetric sculpture of a closed mouth is asked

  HeadTraits traits;
  SkullForm skull{traits};
  NoseForm nose{traits, skull};
  MouthForm mouth{traits, skull};
  EyeForm eye{traits, skull};
  EarForm ear{traits};

 private:
  // Phases.
  double sway_a_ = unit_from_hash(hash_cell(1, 2, 3, traits.seed)) * 6.28;
  double sway_b_ = unit_from_hash(hash_cell(4, 5, 6, traits.seed)) * 6.28;
};

// Turns an implicit surface into triangles: surface nets (S. Gibson, 1998) on a grid that is only
// filled where the surface can be, then steps along the gradient onto the surface itself.
// Thread: one caller; works on all bands of the given pool.
struct Box {
  Vec3 low, high;
};
using Field = std::function<double(Vec3)>;  // negative inside, mm near the surface

// Throws std::bad_alloc only.
Mesh mesh_of_field(const Field& field, const Box& box, double step_mm, ThreadPool& pool);

// Splits the edges whose two ends both satisfy `wanted` and puts the new points on the surface.
void refine(Mesh& mesh, const Field& field, const std::function<bool(Vec3)>& wanted, ThreadPool& pool);

std::vector<Vec3> smooth_normals(const Mesh& mesh);  // weighted by area

}  // namespace relievo::hal::sim
