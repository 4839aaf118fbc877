// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinds of algorithms that make points in space of matches, and judge them.
#pragma once

#include <functional>

#include "pipeline/base/stage.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Accepted matches to points in the left camera's frame, millimetres.
// Errors: TooFewMatches, OutOfMemory, Cancelled.
using Triangulator = std::function<Result<PointCloud>(const RectifiedPair& pair, const MatchSet& matches,
                                                      StageContext& context)>;

// Takes points out of a cloud that do not belong to its surface. The cloud shrinks in place and keeps its
// order. Thread: any. Errors: Cancelled; throws std::bad_alloc as every stage does.
using OutlierFilter = std::function<Result<void>(PointCloud& cloud, StageContext& context)>;

}  // namespace relievo::pipeline
