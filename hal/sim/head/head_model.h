// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the surfaces of a head look like: colour, gloss and the relief too fine for the mesh (pores,
// creases: 0.02 to 0.1 mm). At points of the head frame, mm; colours are linear reflectances.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/shape/head_field.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {

struct Surface {
  Vec3 colour{0.5, 0.5, 0.5};
  double gloss = 0;        // weight of the highlight
  double roughness = 0.4;  // 0 mirror .. 1 dull
  double translucent = 0;  // how far light bleeds round an edge: skin
};

Surface skin_look(const HeadField& field, Vec3 p);
Vec3 skin_slope(const HeadField& field, Vec3 p);  // gradient of its relief's height

struct EyeLook {
  Surface surface;
  Vec3 normal;  // with the bulge of the cornea
};
// `from_centre`: of the eyeball; `gaze`: unit vector to what the eye looks at.
EyeLook eye_look(const HeadTraits& traits, Vec3 from_centre, Vec3 gaze);

// Wet: they mirror the lamps, and are dark between one tooth and the next.
Surface teeth_look(Vec3 p);
Surface tongue_look(const HeadTraits& traits, Vec3 p);

Surface shirt_look(const HeadTraits& traits, Vec3 p);

// Where hair grows and how it lies: scalp, brows, lashes. Head frame, mm.
struct HairStyle {
  Strands strands;
  std::vector<float> tint;   // per node of the strands: 1 is the person's hair colour
  std::vector<float> along;  // per node: 0 root, 1 tip
};

// 0 bare .. 1 full; at head points.
double scalp_hair(const HeadTraits& traits, Vec3 p);
double brow_hair(const HeadField& field, Vec3 p);
double beard_area(const HeadTraits& traits, Vec3 p);

HairStyle grow_hair(const HeadField& field, const Mesh& skin, const std::vector<Vec3>& normals);

// HeadModel: one person's geometry: skin, eyeballs, shirt and every hair, ready for rays, with the
// ambient light that reaches each point. Head frame (head_traits.h). Immutable once built.
struct Shell {  // one solid body
  Mesh mesh;
  std::vector<Vec3> normals;
  std::vector<float> openness;  // 0 .. 1: how much of the sky a point sees
};

class HeadModel {
 public:
  enum Body : std::uint8_t { Skin, Eyes, Inner, Shirt, Teeth, Tongue, BodyCount };

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

// Averages each value with its neighbours': takes the grain out of sampled light.
void smooth_over(const Mesh& mesh, std::vector<float>& values, int times);

}  // namespace relievo::hal::sim
