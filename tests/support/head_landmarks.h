// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a simulated head's named points are, by its own construction.
// Names as Farkas (1994) has them; nasion is sellion, the profile's deepest point. Millimetres, head
// frame (head_traits.h). Thread: any.
#pragma once

#include <string_view>
#include <vector>

#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

struct HeadLandmark {
  std::string_view name;  // "endocanthion_left": the person's
  Vec3 at;
};

std::vector<HeadLandmark> landmarks_of(const HeadField& field);

}  // namespace relievo::hal::sim
