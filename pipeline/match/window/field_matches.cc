// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/field_matches.h"

#include <cmath>

#include "pipeline/match/image/field_reader.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {

Result<MatchSet> matches_in_field(const DisparityField& field, const RectifiedPair& pair,
                                  const Keypoints& keypoints, StageContext& context) {
  constexpr int kRadius = 4, kBandsOfPlaces = 32;
  constexpr float kFitSigmaPx = 1.0F / 6;  // of the fit between pixels, pixels of the field
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  std::pmr::vector<Match> found(keypoints.points.size(), Match{}, &context.scratch);
  context.pool.for_each_band(int(found.size()), kBandsOfPlaces, [&](int begin, int end, int) {
    for (int k = begin; k < end && !context.stop(); ++k) {
      const Vec2f at = keypoints.points[std::size_t(k)].at_px;
      const Vec2f in_field{(at.x - field.corner_px.x) / field.scale,
                           (at.y - field.corner_px.y) / field.scale};
      const FieldReading reading = read_disparity(field.values, in_field, field.nothing);
      if (!reading.known) continue;
      const float d = field.scale * reading.disparity;
      found[std::size_t(k)] = {at, d, window_cost(pair, at, d, kRadius),
                               field.scale * std::hypot(kFitSigmaPx, reading.scatter), 0};
    }
  });
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching"};
  for (const Match& match : found)
    if (match.sigma_px > 0 && match.cost < 1) set.matches.push_back(match);
  if (set.matches.empty()) return nothing_matches();
  return set;
}

Error nothing_matches() {
  return {Errc::TooFewMatches,
          "hardly anything matches between the views: is the face in both, in focus and lit?"};
}

}  // namespace relievo::pipeline
