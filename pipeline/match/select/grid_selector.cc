// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/grid_selector.h"

#include "pipeline/match/select/keypoint_choice.h"

namespace relievo::pipeline {

Result<void> GridSelectorOptions::check() const {
  if (step_px < 1 || step_px > 256 || max_points < 1 || max_points > 1'000'000)
    return Error{Errc::InvalidInput, "grid: step_px must lie in 1 .. 256 and max_points in 1 .. 1000000"};
  return {};
}

Result<Keypoints> GridSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(options_.check());
  RELIEVO_TRY(check_pixels_of_left(pair));
  int step = options_.step_px;
  while (true) {
    if (context.stop()) return Error{Errc::Cancelled, "the choice of keypoints was stopped"};
    if (count_lattice(pair, step) <= static_cast<std::size_t>(options_.max_points)) break;
    ++step;
  }
  return lattice_keypoints(pair, step, context);
}

}  // namespace relievo::pipeline
