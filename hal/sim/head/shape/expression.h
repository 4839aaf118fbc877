// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a simulated person does with the face: the default is at rest, eyes open, lips together. Millimetres.
#pragma once

namespace relievo::hal::sim {

struct Expression {
  double lids_open = 1;  // of the person's own opening; 0: closed, the upper lid come down to the lower
  double jaw_mm = 0;     // how far the lower lip has dropped in the middle; the chin goes with it
  double smile = 0;      // 0 .. 1: the corners of the mouth drawn outwards and up
  double tongue_mm = 0;  // how far it is put out before the lips; needs a jaw dropped by some 10 mm
};

}  // namespace relievo::hal::sim
