// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/dense_selector.h"

namespace relievo::pipeline {

Result<void> DenseSelectorOptions::check() const {
  if (step_px < 1) return Error{Errc::InvalidInput, "dense: step_px must be at least 1"};
  return {};
}

Result<Keypoints> DenseSelector::select(const RectifiedPair& pair, StageContext& context) const {
  const auto wanted = [&](int x, int y) {
    const std::size_t k = static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) + static_cast<std::size_t>(x);
    return pair.left.valid[k] != 0 && (pair.region.empty() || pair.region[k] != 0);
  };
  std::size_t count = 0;
  for (int y = 0; y < pair.height_px; y += options_.step_px)
    for (int x = 0; x < pair.width_px; x += options_.step_px) count += wanted(x, y) ? 1 : 0;
  if (count == 0) return Error{Errc::NoFace, "the face region is empty: nothing to match"};
  Keypoints keypoints(&context.output);
  keypoints.lattice_step_px = options_.step_px;
  keypoints.points.reserve(count);
  for (int y = 0; y < pair.height_px; y += options_.step_px)
    for (int x = 0; x < pair.width_px; x += options_.step_px)
      if (wanted(x, y)) keypoints.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
  return keypoints;
}

}  // namespace relievo::pipeline
