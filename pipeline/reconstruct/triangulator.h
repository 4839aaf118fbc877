// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangulator: accepted matches to points in the left camera's frame, millimetres.
// Errors: TooFewMatches, OutOfMemory, Cancelled.
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class Triangulator {
 public:
  virtual ~Triangulator() = default;
  virtual std::string_view name() const = 0;
  virtual Result<PointCloud> triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                         StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
