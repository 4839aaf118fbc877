// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/dense_selector.h"

#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {

Result<Keypoints> DenseSelector::select(const RectifiedPair& pair, StageContext& context) const {
  if (context.stop()) return Error{Errc::Cancelled, "the choice of keypoints was stopped"};
  RELIEVO_TRY(check_pixels_of_left(pair));
  return lattice_keypoints(pair, step_px, {0, 0, pair.width_px - 1, pair.height_px - 1}, context);
}

}  // namespace relievo::pipeline
