// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/harris_selector.h"

#include <cmath>

#include "pipeline/match/select/response/corner_response.h"

namespace relievo::pipeline {

Result<Keypoints> HarrisSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels_of_left(pair));
  const Error stopped{Errc::Cancelled, "the choice of keypoints was stopped"};
  if (context.stop()) return stopped;
  const Selectable selectable(pair, &context.scratch);
  RELIEVO_TRY(check_selectable(selectable));
  Plane<float> response(&context.scratch, pair.width_px, pair.height_px);
  Plane<float> chosen(&context.scratch, pair.width_px, pair.height_px);
  if (!corner_response(pair.left.grey, selectable, {window_px / 2, 3}, harris_measure,
                       static_cast<float>(sensitivity), context, response))
    return stopped;
  if (const float strongest = greatest(response); strongest > 0) {
    for (float& r : response.values) r /= strongest;
    Candidates peaks =
        peaks_of(response, static_cast<float>(std::pow(quality, 4)), 1, context, &context.scratch);
    if (context.stop()) return stopped;
    choose_spread(peaks, min_distance_px, max_points, chosen, context.scratch);
  }
  return keypoints_of(chosen, max_points, context);
}

}  // namespace relievo::pipeline
