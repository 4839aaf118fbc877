// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// KeypointSelector: chooses the places of the left rectified view that are to be matched.
// Errors: NoFace (nothing to choose from), OutOfMemory, Cancelled.
#pragma once

#include <string_view>

#include "pipeline/model/keypoint.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/stage.h"

namespace relievo::pipeline {

class KeypointSelector {
 public:
  virtual ~KeypointSelector() = default;
  virtual std::string_view name() const = 0;
  virtual Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
