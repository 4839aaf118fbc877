// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/wavelet_salient_selector.h"

#include <algorithm>

#include "pipeline/match/select/response/keypoint_choice.h"
#include "pipeline/match/select/response/salient_tracks.h"

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
  RELIEVO_TRY(check_pixels_of_left(pair));
  const Error stopped{Errc::Cancelled, "the choice of keypoints was stopped"};
  if (context.stop()) return stopped;
  const Selectable selectable(pair, &context.scratch);
  RELIEVO_TRY(check_selectable(selectable));
  const SalientTracks tracks(pair.left.grey, pair.width_px, pair.height_px, scales, &context.scratch);
  Plane<float> saliency(&context.scratch, pair.width_px, pair.height_px);
  mark_ends(tracks, selectable, context.pool, saliency);
  if (context.stop()) return stopped;
  Plane<float> chosen(&context.scratch, pair.width_px, pair.height_px);
  if (const float most = greatest(saliency); most > 0) {
    for (float& s : saliency.values) s /= most;
    Candidates ends = peaks_of(saliency, static_cast<float>(quality), 0, context, &context.scratch);
    choose_spread(ends, min_distance_px, max_points, chosen, context.scratch);
  }
  return keypoints_of(chosen, max_points, context);
}

}  // namespace relievo::pipeline
