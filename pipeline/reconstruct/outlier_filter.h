// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OutlierFilter: takes points out of a cloud that do not belong to its surface. The cloud shrinks in place
// and keeps its order. Thread: any. Errors: InvalidInput (options), Cancelled; throws std::bad_alloc as every
// stage does.
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

class OutlierFilter {
 public:
  virtual ~OutlierFilter() = default;
  virtual std::string_view name() const = 0;
  virtual Result<void> reject(PointCloud& cloud, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
