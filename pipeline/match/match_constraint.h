// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MatchConstraint: judges matches; marks the ones it rejects with its bit and erases none, so that
// the technician can see which rule took a point away. Matches already rejected are not asked.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class MatchConstraint {
 public:
  virtual ~MatchConstraint() = default;
  virtual std::string_view name() const = 0;
  virtual void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px,
                     std::uint16_t bit, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
