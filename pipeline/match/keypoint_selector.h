// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// KeypointSelector: chooses the places of the left rectified view that are to be matched.
// Errors: NoFace (nothing to choose from), OutOfMemory, Cancelled.
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class KeypointSelector {
 public:
  virtual ~KeypointSelector() = default;
  virtual std::string_view name() const = 0;
  // Its keypoints lie on a lattice (Keypoints::lattice_step_px > 0), as some meshers need.
  virtual bool on_lattice() const { return false; }
  virtual Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
