// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/constraints.h"

#include <cmath>
#include <utility>

#include "pipeline/match/window/patch_scores.h"

namespace relievo::pipeline {
namespace {

constexpr int kAskedBands = 32;

enum class Answer : std::uint8_t { Confirmed, Elsewhere, Unasked };

// `scores` has the views exchanged: its left view is the pair's right one, and disparities change sign.
Answer ask_back(const Match& match, const LeftRightConstraint& options, PatchScores& scores) {
  const float right = match.left_px.x - match.disparity_px;
  const int middle = int(std::lround(match.disparity_px));
  const int count = 2 * options.search_px + 1;
  // Candidate k lies at right + middle + search_px - k on the left row.
  if (!scores.load({right, match.left_px.y}, -(middle + options.search_px), count)) return Answer::Unasked;
  if (!std::isfinite(scores.score(options.search_px).unlike)) return Answer::Unasked;
  int best = 0;
  double least = scores.score(0).unlike;
  for (int k = 1; k < count; ++k)
    if (const double here = scores.score(k).unlike; here < least) {
      least = here;
      best = k;
    }
  if (best == 0 || best == count - 1) return Answer::Elsewhere;
  const double before = scores.score(best - 1).unlike;
  const double after = scores.score(best + 1).unlike;
  const double bend = before - 2 * least + after;
  const double offset = std::isfinite(bend) && bend > 0 ? (before - after) / (2 * bend) : 0;
  const double found = double(right) + middle + options.search_px - best - offset;
  return std::abs(found - double(match.left_px.x)) <= double(options.limit_px) ? Answer::Confirmed
                                                                               : Answer::Elsewhere;
}

}  // namespace

void LeftRightConstraint::judge(const RectifiedPair& pair, std::span<Match> matches, int, std::uint16_t bit,
                                StageContext& context) const {
  if (matches.empty() || pair.left.grey.empty() || pair.right.grey.empty()) return;
  Arena::Mark mark(context.scratch);
  ChannelPlanes planes = make_channel_planes(pair, 1, window_px / 2, context);
  std::swap(planes.left, planes.right);
  std::swap(planes.whole_left, planes.whole_right);
  std::pmr::vector<PatchScores> scores(&context.scratch);
  scores.reserve(kAskedBands);
  for (int band = 0; band < kAskedBands; ++band)
    scores.emplace_back(planes, WindowScore::ZeroMeanCorrelation, 2 * search_px + 1, &context.scratch);
  context.pool.for_each_band(int(matches.size()), kAskedBands, [&](int begin, int end, int band) {
    for (int k = begin; k < end && !context.stop(); ++k) {
      Match& match = matches[std::size_t(k)];
      if (match.rejected_by != 0 || !(std::abs(match.disparity_px) < 1e6F)) continue;
      if (ask_back(match, *this, scores[std::size_t(band)]) == Answer::Elsewhere) match.rejected_by = bit;
    }
  });
}

}  // namespace relievo::pipeline
