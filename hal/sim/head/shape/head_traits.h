// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadTraits: the numbers that make one person's head, drawn from a seed.
//
// Means and deviations follow L. G. Farkas, Anthropometry of the Head and Face (2nd ed., 1994) and
// Farkas et al., International Anthropometric Study of Facial Morphology (J. Craniofac. Surg. 16,
// 2005), young adults, a mix of women and men; widened a little where populations differ most.
// Lengths in mm. Head frame: origin between the pupils' heights on the midline, above the tragion;
// x to the person's left, y up, z out of the face.
#pragma once

#include <cstdint>

#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

// What a simulated person does with the face: the default is at rest, eyes open, lips together. Millimetres.
struct Expression {
  double lids_open = 1;  // of the person's own opening; 0: closed, the upper lid come down to the lower
  double jaw_mm = 0;     // how far the lower lip has dropped in the middle; the chin goes with it
  double smile = 0;      // 0 .. 1: the corners of the mouth drawn outwards and up
  double tongue_mm = 0;  // how far it is put out before the lips; needs a jaw dropped by some 10 mm
};

struct HeadTraits {
  std::uint32_t seed = 0;
  double masculine = 0.5;  // 0 .. 1
  double age = 0.3;        // 0: twenty, 1: seventy
  // Farkas' measures, by his names.
  double head_breadth = 150;      // eu-eu
  double face_breadth = 135;      // zy-zy
  double jaw_breadth = 104;       // go-go
  double head_length = 192;       // g-op
  double nose_height = 52;        // n-sn
  double upper_lip = 21.5;        // sn-sto
  double lower_face = 48;         // sto-gn
  double nose_width = 34.5;       // al-al
  double nose_protrusion = 19.5;  // sn-prn
  double intercanthal = 32.5;     // en-en
  double eye_fissure = 30.8;      // ex-en
  double mouth_width = 52;        // ch-ch
  double ear_height = 61;         // sa-sba
  // Form: 0 is the average, +-1 one deviation, unless said otherwise.
  double brow_ridge = 0, bridge = 0, hump = 0, tip_up = 0, tip_size = 0;
  double lip_fullness = 0, cheekbone = 0, fullness = 0, chin = 0, eye_tilt = 0, eye_open = 0;
  double forehead = 0, lid_fold = 0, ear_out = 0, eye_depth = 0, mouth_curve = 0, chin_breadth = 0;
  // Looks.
  Vec3 skin{0.62, 0.42, 0.32};  // linear reflectance
  Vec3 iris{0.10, 0.06, 0.03};
  Vec3 hair{0.03, 0.02, 0.012};
  double freckles = 0, stubble = 0;  // 0 .. 1
  double hairline_y = 78;            // trichion above the pupils
  double hair_length = 16, brow_density = 1;
  double hair_part = 0.3;  // side of the parting
  double shine = 1;        // 0: powdered
  int shirt = 0;
  // No person has this: waves along x over the whole face, to see what detail a measurement keeps.
  double ripple_mm = 0, ripple_wave_mm = 6;
  Expression expression;  // at rest, whatever the seed
};

HeadTraits traits_of(std::uint32_t seed);

// Heights that several parts share.
constexpr double kNasionY = 7;
constexpr double subnasale_y(const HeadTraits& t) { return kNasionY - t.nose_height; }
constexpr double stomion_y(const HeadTraits& t) { return subnasale_y(t) - t.upper_lip; }
constexpr double gnathion_y(const HeadTraits& t) { return stomion_y(t) - t.lower_face; }

}  // namespace relievo::hal::sim
