// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/selectors.h"

#include <algorithm>

#include "pipeline/match/select/response/corner_response.h"
#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;

// Bands of whole blocks of the coarsest scale: no track leaves its band.
void mark_ends(const SalientTracks& tracks, const Selectable& selectable, ThreadPool& pool,
               Plane<float>& saliency) {
  const int block = 1 << tracks.scales();
  pool.for_each_band((saliency.height + block - 1) / block, kBands, [&](int begin, int end, int) {
    for (int scale = 1; scale <= tracks.scales(); ++scale) {
      const int side = 1 << scale;
      const int last = std::min(tracks.rows(scale), end * (block / side));
      for (int row = begin * (block / side); row < last; ++row)
        for (int column = 0; column < tracks.columns(scale); ++column) {
          if (!selectable.valid_block(column * side, row * side, side)) continue;
          for (int orientation = 0; orientation < SalientTracks::kOrientations; ++orientation) {
            if (!(tracks.magnitude(scale, orientation, column, row) > 0)) continue;
            const Candidate found = tracks.follow(scale, orientation, column, row);
            if (!selectable(found.x, found.y, 1)) continue;
            float& there = saliency.row(found.y)[found.x];
            there = std::max(there, found.strength);
          }
        }
    }
  });
}

}  // namespace

Result<Keypoints> WaveletSalientSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const SalientTracks tracks(pair.left.grey, pair.width_px, pair.height_px, scales, &context.scratch);
  Plane<float> saliency(&context.scratch, pair.width_px, pair.height_px);
  mark_ends(tracks, selectable, context.pool, saliency);
  if (context.stop()) return selection_stopped();
  return peak_keypoints(saliency, {quality, 0, static_cast<double>(min_distance_px), max_points}, context);
}

}  // namespace relievo::pipeline
