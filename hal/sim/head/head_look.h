// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the surfaces of a head look like: colour, gloss and the relief too fine for the mesh (pores,
// creases: 0.02 to 0.1 mm). At points of the head frame, mm; colours are linear reflectances.
#pragma once

#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

struct Surface {
  Vec3 colour{0.5, 0.5, 0.5};
  double gloss = 0;        // weight of the highlight
  double roughness = 0.4;  // 0 mirror .. 1 dull
  double translucent = 0;  // how far light bleeds round an edge: skin
};

class SkinLook {
 public:
  explicit SkinLook(const HeadField& field) : field_(field), t_(field.traits) {}
  Surface surface(Vec3 p) const;
  Vec3 relief_slope(Vec3 p) const;  // gradient of the relief's height

 private:
  double blood(Vec3 q) const;
  double melanin(Vec3 p, Vec3 q) const;
  Vec3 complexion(Vec3 p, Vec3 q, double dark) const;
  Vec3 with_lid(Vec3 c, Vec3 q) const;
  double height(Vec3 p, double lip, double coarse) const;
  const HeadField& field_;
  const HeadTraits& t_;
};

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

}  // namespace relievo::hal::sim
