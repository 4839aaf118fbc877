// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_matching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pipeline/match/window/lattice_search.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 32;
constexpr double kFitBiasPx =
    0.03;  // rms of the parabola's pull towards whole pixels, textures of 5 to 20 pixels
constexpr double kFaceBend = 1.0 / 40;  // 1/mm: between a cheek and the tip of a nose

// Rows of the keypoints, where they lie on pixels of a lattice as they say; else none.
std::optional<LatticeRows> rows_of(const Keypoints& keypoints, int height) {
  if (keypoints.lattice_step_px < 1 || keypoints.points.empty()) return std::nullopt;
  float least = keypoints.points.front().at_px.y;
  float most = least;
  for (const Keypoint& k : keypoints.points) {
    if (k.at_px.x != std::floor(k.at_px.x) || k.at_px.y != std::floor(k.at_px.y)) return std::nullopt;
    least = std::min(least, k.at_px.y);
    most = std::max(most, k.at_px.y);
  }
  if (least < 0 || most >= static_cast<float>(height)) return std::nullopt;
  const LatticeRows rows{static_cast<int>(least), keypoints.lattice_step_px,
                         (static_cast<int>(most) - static_cast<int>(least)) / keypoints.lattice_step_px + 1};
  for (const Keypoint& k : keypoints.points)
    if ((static_cast<int>(k.at_px.y) - rows.first_px) % rows.step_px != 0) return std::nullopt;
  return rows;
}

struct Fit {
  float disparity_px = 0;
  float cost = 1;
  float sigma_px = 0;  // 0: no minimum
  double unlike = 0;
};

Fit fit_minimum(const PatchScores::Score& before, const PatchScores::Score& here,
                const PatchScores::Score& after, int disparity, double bias, const WindowRule& rule) {
  Fit fit;
  const double bend = before.unlike - 2 * here.unlike + after.unlike;
  if (!std::isfinite(bend) || !(bend > 0) || here.unlike > before.unlike || here.unlike > after.unlike)
    return fit;
  const double tilt = before.unlike - after.unlike;
  const double steep = std::max(before.unlike, after.unlike) - here.unlike;
  const double offset = rule.equiangular ? tilt / (2 * steep) : tilt / (2 * bend);
  const double samples = rule.window_px * rule.window_px;
  // The parabola's minimum, but never less than rounding to eight bits leaves.
  const double least = std::max(here.unlike - tilt * tilt / (8 * bend), 1e-6 * bend);
  fit.disparity_px = static_cast<float>(disparity + offset);
  fit.cost = static_cast<float>(here.cost);
  fit.unlike = here.unlike;
  fit.sigma_px = static_cast<float>(std::sqrt(2 * least / (samples * bend) + bias * bias));
  return fit;
}

class WindowMatching {
 public:
  WindowMatching(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                 StageContext& context)
      : keypoints_(keypoints),
        rule_(rule),
        bias_px_(method_bias_px(pair, rule.window_px)),
        range_(disparity_range(pair)),
        rows_(rows_of(keypoints, pair.height_px)),
        planes_(make_channel_planes(pair, rule.channels, rule.window_px / 2, context)),
        best_(&context.scratch, pair.width_px, rows_ ? rows_->count : 0),
        fits_(keypoints.points.size(), Fit{}, &context.scratch),
        scores_(&context.scratch) {
    scores_.reserve(kBands);
    for (int band = 0; band < kBands; ++band)
      scores_.emplace_back(planes_, rule.score, rows_ ? 3 : range_.count(), &context.scratch);
  }

  void run(StageContext& context) {
    if (rows_) search_lattice(planes_, rule_.score, range_, *rows_, context, best_);
    context.progress.done.store(0.8F, std::memory_order_relaxed);
    const int count = static_cast<int>(keypoints_.points.size());
    context.pool.for_each_band(count, kBands, [&](int begin, int end, int band) {
      for (int k = begin; k < end; ++k) {
        if (k % 64 == 0 && context.stop()) return;
        PatchScores& scores = scores_[static_cast<std::size_t>(band)];
        fits_[static_cast<std::size_t>(k)] =
            rows_ ? fit_at_node(keypoints_.points[static_cast<std::size_t>(k)].at_px, scores)
                  : fit_anywhere(keypoints_.points[static_cast<std::size_t>(k)].at_px, scores);
      }
    });
  }

  void hand_on(MatchSet& set) const {
    const double scale = rule_.score == WindowScore::SquaredDifferences
                             ? rule_.window_px * rule_.window_px * rule_.channels
                             : 1;
    for (std::size_t k = 0; k < fits_.size(); ++k) {
      const Fit& fit = fits_[k];
      if (fit.sigma_px > 0 && fit.sigma_px <= rule_.sigma_limit_px && fit.unlike <= rule_.most_unlike * scale)
        set.matches.push_back({keypoints_.points[k].at_px, fit.disparity_px, fit.cost, fit.sigma_px, 0});
    }
  }

 private:
  Fit fit_at_node(Vec2f at, PatchScores& scores) {
    const int x = static_cast<int>(at.x);
    if (x < 0 || x >= best_.width) return {};
    const int d = best_.row((static_cast<int>(at.y) - rows_->first_px) / rows_->step_px)[x];
    if (d <= range_.first || d >= range_.last || !scores.load(at, d - 1, 3)) return {};
    return fit_minimum(scores.score(0), scores.score(1), scores.score(2), d, bias_px_, rule_);
  }

  Fit fit_anywhere(Vec2f at, PatchScores& scores) {
    if (!scores.load(at, range_.first, range_.count())) return {};
    int best = 0;
    PatchScores::Score least{std::numeric_limits<double>::infinity(), 1};
    for (int k = 0; k < range_.count(); ++k)
      if (const PatchScores::Score here = scores.score(k); here.unlike < least.unlike) {
        least = here;
        best = k;
      }
    if (best == 0 || best == range_.count() - 1) return {};
    return fit_minimum(scores.score(best - 1), least, scores.score(best + 1), range_.first + best, bias_px_,
                       rule_);
  }

  const Keypoints& keypoints_;
  const WindowRule& rule_;
  double bias_px_;
  DisparityRange range_;
  std::optional<LatticeRows> rows_;
  ChannelPlanes planes_;
  Plane<int> best_;
  std::pmr::vector<Fit> fits_;
  std::pmr::vector<PatchScores> scores_;
};

}  // namespace

// What a window takes off a surface bent both ways: (w^2 - 1) / 24 times its second derivatives, each of
// which is bend * baseline / focal length.
double method_bias_px(const RectifiedPair& pair, int window_px) {
  const double flattened =
      (window_px * window_px - 1) / 24.0 * 2 * kFaceBend * pair.baseline_mm / pair.focal_px;
  return std::hypot(kFitBiasPx, flattened);
}

Result<MatchSet> match_windows(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                               StageContext& context) {
  const auto pixels = static_cast<std::size_t>(pair.width_px) * static_cast<std::size_t>(pair.height_px);
  if (pixels == 0 || pair.left.grey.size() != pixels || pair.right.grey.size() != pixels)
    return Error{Errc::InvalidInput, "the rectified pair has no pixels"};
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  WindowMatching matching(pair, keypoints, rule, context);
  matching.run(context);
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching windows"};
  matching.hand_on(set);
  if (set.matches.empty())
    return Error{
        Errc::TooFewMatches,
        "no window of the left view is found again in the right one: is the face in both, in focus and lit?"};
  return set;
}

}  // namespace relievo::pipeline
