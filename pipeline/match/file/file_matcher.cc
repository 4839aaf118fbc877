// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/file_matcher.h"

#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr int kCorrelationRadius = 4;

}  // namespace

Result<MatchSet> FileMatcher::match(const RectifiedPair& pair, const Keypoints&,
                                    StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (file.path.empty())
    return Error{Errc::NotFound, "no file of matches is named: --set file-matches.path=FILE"}.at(
        "file-matches.path");
  if (file.text == nullptr)
    return Error{Errc::NotFound, "this file of matches could not be read; check its name"}.at(file.path);
  MatchSet set(&context.output);
  RELIEVO_TRY_ASSIGN(set.matches, matches_in(*file.text, file.path, pair, sigma_px, &context.output));
  for (Match& match : set.matches) {
    if (context.stop()) return Error{Errc::Cancelled, "stopped while reading matches"};
    match.cost = window_cost(pair, match.left_px, match.disparity_px, kCorrelationRadius);
  }
  if (set.matches.empty()) return Error{Errc::TooFewMatches, "the file holds no match"}.at(file.path);
  return set;
}

}  // namespace relievo::pipeline
