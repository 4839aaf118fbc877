// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/random_selector.h"

#include <algorithm>
#include <random>

#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {

Result<Keypoints> RandomSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels_of_left(pair));
  if (context.stop()) return Error{Errc::Cancelled, "the choice of keypoints was stopped"};
  const Selectable selectable(pair, &context.scratch);
  RELIEVO_TRY(check_selectable(selectable));
  std::size_t left = selectable.count();
  std::size_t wanted = std::min(left, static_cast<std::size_t>(max_points));
  Keypoints keypoints(&context.output);
  keypoints.points.reserve(wanted);
  // The engine's numbers are fixed by the standard; its distributions are not.
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  for (int y = 0; y < pair.height_px && wanted > 0; ++y)
    for (int x = 0; x < pair.width_px && wanted > 0; ++x) {
      if (!selectable(x, y, 0)) continue;
      if (unit() * static_cast<double>(left--) >= static_cast<double>(wanted)) continue;
      keypoints.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
      --wanted;
    }
  return keypoints;
}

}  // namespace relievo::pipeline
