// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the tip of the nose is. What is nearest to the cameras is it only on a head held upright: of a bowed
// one the bridge or the brow is nearer, of one that looks up the chin or a tongue. So it is told by form,
// twice: roughly, as what stands out of the plane that the face about the hint lies in; and, once the axes of
// the head are known, as the peak of its profile along the mirror plane (pronasale: the foremost point of the
// nose on a head held straight, Farkas 1994). Frame: that of the relief, millimetres. Memory: scratch.
// Thread: any; deterministic. Errors: none, false where too little is known.
#pragma once

#include "pipeline/gate/head/head_measurement.h"

namespace relievo::pipeline {

// By the hint alone. False where the most of the box about it is not known, or is not as wide as a face.
bool rough_tip(const Relief& relief, const HeadHint& hint, StageContext& context, Vec3d& tip);

// Asks of `head` the axes, the pitch and a tip that may be wrong; the new one lies on the surface within
// 14 mm of its mirror plane.
bool tip_of_profile(const Relief& relief, const HeadHint& hint, const HeadMeasurement& head,
                    StageContext& context, Vec3d& tip);

}  // namespace relievo::pipeline
