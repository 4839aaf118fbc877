// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/live_calibration.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hal/base/assert.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/live/view_planner.h"

namespace relievo::pipeline {
namespace {

constexpr int kUselessPairs = 3;
constexpr double kStillPx = 2;       // root mean square of the corners' motion since the pair before
constexpr double kSharpPx = 4;       // width of the board's edges, 10 to 90 % (board_tracker.h)
constexpr double kLeastWorth = 0.3;  // of a view, share of what the best one would bring
constexpr int kPatiencePairs = 100;  // on the way to one target, before another is chosen

// Cables that were exchanged while a live calibration runs.

// A rig known from few views may miss by pixels; an exchange makes it worse by far more than that.
constexpr double kSuspectPx = 1;
constexpr double kFarBetter = 0.3;

double rms_px(bundle::Problem rig, const BoardCorners& left, const BoardCorners& right) {
  return lay_board(rig, left, right) ? std::sqrt(2 * rig.squared_px / rig.residuals) : 1e9;
}

constexpr int kLeastCorners = 12;  // of a ChArUco board that both cameras see
constexpr double kLeastCharucoShare = 0.3;

double moved_px(const BoardCorners& before, BoardCorners now, const BoardPattern& pattern) {
  pair_order(before, now, pattern);  // the half turn that a chessboard leaves open is no motion
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!seen(before[i]) || !seen(now[i])) continue;
    sum += (now[i].x - before[i].x) * (now[i].x - before[i].x) +
           (now[i].y - before[i].y) * (now[i].y - before[i].y);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 1e9;
}

// The board's squares are not as large as was said, which no further view puts right; few views know the
// baseline less well.
bool is_of_another_size(const CalibrationQuality& q) {
  constexpr double kSigmas = 3;
  return q.expected_baseline_mm > 0 && std::abs(q.baseline_mm - q.expected_baseline_mm) >
                                           limits::kBaselinePercent / 100 * q.expected_baseline_mm +
                                               kSigmas * q.uncertainty.parameters.baseline_mm;
}

// One camera a thread.
template <typename T, typename Work>
std::array<Result<T>, 2> for_both(ThreadPool& pool, const Work& work) {
  std::array<Result<T>, 2> done{T{}, T{}};
  pool.for_each(2, 2, [&](int eye) { done[std::size_t(eye)] = work(std::size_t(eye)); });
  return done;
}

}  // namespace

void ViewCollector::advise() {
  state_.how_far = 0;
  state_.way.clear();
  state_.advice = advice_for_verdict();
  // Not every person reaches every target; another one will do.
  const bool tries = state_.verdict != PairVerdict::NoBoard && state_.verdict != PairVerdict::Taken;
  if (tries && ++pairs_on_target_ > kPatiencePairs) give_up_target();
}

LiveAdvice ViewCollector::advice_for_verdict() {
  if (state_.done()) return LiveAdvice::Done;
  if (swapped_) return LiveAdvice::SwappedCameras;
  switch (state_.verdict) {
    case PairVerdict::Finished: return LiveAdvice::Done;
    case PairVerdict::Swapped: return LiveAdvice::SwappedCameras;
    case PairVerdict::NoBoard: return LiveAdvice::ShowBoard;
    case PairVerdict::LeftMissesIt: return LiveAdvice::LeftCameraMissesIt;
    case PairVerdict::RightMissesIt: return LiveAdvice::RightCameraMissesIt;
    case PairVerdict::Blurred: return LiveAdvice::TooBlurred;
    case PairVerdict::Taken:
    case PairVerdict::Moving:
    case PairVerdict::AlreadyHave: return towards_target();
  }
  return LiveAdvice::ShowBoard;
}

LiveAdvice ViewCollector::towards_target() {
  Room room{double(input_.width_px), double(input_.height_px), {}};
  for (std::size_t eye = 0; eye < 2; ++eye)
    room.board[eye] = with_border(outline_of(state_.corners[eye], input_.pattern), input_.pattern);
  auto way = guide_.towards(target_.target, now_[0], room);
  if (!way && state_.verdict == PairVerdict::AlreadyHave) {
    if (++useless_pairs_ < kUselessPairs) return LiveAdvice::AlreadyHave;
    give_up_target();
    way = guide_.towards(target_.target, now_[0], room);
  }
  if (!way) return LiveAdvice::HoldStill;
  state_.how_far = way->how_far;
  state_.way = words_towards(target_.target, now_[0]);
  const auto now = std::ranges::find(state_.way, way->word);
  if (now != state_.way.end()) std::rotate(state_.way.begin(), now, now + 1);
  return way->word;
}

void ViewCollector::give_up_target() {
  if (std::ranges::find(given_up_, target_.number) == given_up_.end()) given_up_.push_back(target_.number);
  aim();
}

Result<void> LiveOptions::check() const {
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  if (!within(goal_mm, 0.001, 100)) return invalid("the goal must be 0.001 to 100 mm").at("goal_mm");
  if (!within(full_bar, 0, 1)) return invalid("a coverage bar goes from 0 to 1").at("full_bar");
  if (min_views < kMinBoardPairs || max_views < min_views || max_views > kMaxBoardPairs)
    return invalid("wants 5 <= min_views <= max_views <= 500").at("min_views, max_views");
  if (!within(plateau_gain, 0, 0.5)) return invalid("must be 0 to 0.5").at("plateau_gain");
  return {};
}

Result<ViewCollector> ViewCollector::begin(const BoardPattern& pattern, int width_px, int height_px,
                                           const LiveOptions& options) {
  RELIEVO_TRY(pattern.check());
  RELIEVO_TRY(options.check());
  if (width_px < 16 || height_px < 16 || width_px > 8192 || height_px > 8192)
    return invalid("pictures must have 16 to 8192 pixels a side");
  return ViewCollector(pattern, width_px, height_px, options);
}

ViewCollector::ViewCollector(const BoardPattern& pattern, int width_px, int height_px,
                             const LiveOptions& options)
    : options_(options), planner_(std::make_unique<ViewPlanner>()) {
  input_.pattern = pattern;
  input_.width_px = width_px;
  input_.height_px = height_px;
  input_.expected_baseline_mm = options.expected_baseline_mm;
  input_.in_use = options.in_use;
  const auto most = std::size_t(options.max_views);
  input_.views.reserve(most);
  taken_.reserve(most);
  state_.goal_mm = options.goal_mm;
  aim();
}

ViewCollector::ViewCollector(ViewCollector&& other) noexcept = default;
ViewCollector& ViewCollector::operator=(ViewCollector&& other) noexcept = default;
ViewCollector::~ViewCollector() = default;

Result<void> ViewCollector::check(const PairDetection& pair) const {
  const auto corners = std::size_t(input_.pattern.corners());
  for (const BoardDetection& one : pair.seen)
    if (!one.corners.empty() && one.corners.size() != corners)
      return invalid("a board with another number of corners than the pattern")
          .at("pair " + std::to_string(state_.pairs + 1));
  if (last_ && pair.at <= last_->at)
    return invalid("pairs must come in the order of their times")
        .at("pair " + std::to_string(state_.pairs + 1));
  return {};
}

bool ViewCollector::is_new() const {
  if (!pipeline::is_new(now_, taken_, 1)) return false;
  return best_worth_ <= 0 ||
         planner_->worth(state_.corners[0], state_.corners[1]) >= kLeastWorth * best_worth_;
}

PairVerdict ViewCollector::judge(const PairDetection& pair) const {
  const BoardCorners& left = pair.seen[0].corners;
  const BoardCorners& right = pair.seen[1].corners;
  if (state_.done()) return PairVerdict::Finished;
  if (swapped_) return PairVerdict::Swapped;
  if (left.empty() && right.empty()) return PairVerdict::NoBoard;
  if (left.empty()) return PairVerdict::LeftMissesIt;
  if (right.empty()) return PairVerdict::RightMissesIt;
  const double least = std::max<double>(kLeastCorners, kLeastCharucoShare * input_.pattern.corners());
  int in_both = 0;
  for (std::size_t i = 0; i < left.size(); ++i) in_both += seen(left[i]) && seen(right[i]) ? 1 : 0;
  if (in_both < std::min<double>(least, input_.pattern.corners())) return PairVerdict::NoBoard;
  const bool known = last_ && !last_->seen[0].corners.empty() && !last_->seen[1].corners.empty();
  if (!known || std::max(state_.moved_px[0], state_.moved_px[1]) > kStillPx) return PairVerdict::Moving;
  if (std::max(pair.seen[0].edge_px, pair.seen[1].edge_px) > kSharpPx) return PairVerdict::Blurred;
  if (newest_) {
    // Does the pair, which is in pair_order(), fit far better with left and right exchanged than as it is?
    const bundle::Problem rig = rig_problem(newest_->calibration, input_.pattern);
    const double as_given = rms_px(rig, left, right);
    if (as_given > kSuspectPx && rms_px(rig, right, left) < kFarBetter * as_given)
      return PairVerdict::Swapped;
  }
  if (!is_new()) return PairVerdict::AlreadyHave;
  return PairVerdict::Taken;
}

Result<bool> ViewCollector::consider(PairDetection pair) {
  RELIEVO_TRY(check(pair));
  ++state_.pairs;
  BoardCorners& left = pair.seen[0].corners;
  BoardCorners& right = pair.seen[1].corners;
  if (!left.empty() && !right.empty()) pair_order(left, right, input_.pattern);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const BoardDetection& one = pair.seen[eye];
    const bool known = last_ && !one.corners.empty() && !last_->seen[eye].corners.empty();
    state_.moved_px[eye] = known ? moved_px(last_->seen[eye].corners, one.corners, input_.pattern) : 0;
    state_.corners[eye] = one.corners;
    state_.edge_px[eye] = one.edge_px;
    now_[eye] = one.corners.empty()
                    ? BoardParameters{}
                    : parameters_of(one.corners, input_.pattern, input_.width_px, input_.height_px);
  }
  state_.verdict = judge(pair);
  last_ = std::move(pair);
  if (state_.verdict == PairVerdict::Taken) return true;
  advise();
  return false;
}

Result<void> ViewCollector::take(BoardCorners left, BoardCorners right) {
  RELIEVO_ASSERT(state_.verdict == PairVerdict::Taken);
  const auto corners = std::size_t(input_.pattern.corners());
  if (left.size() != corners || right.size() != corners)
    return invalid("a board with another number of corners than the pattern");
  pair_order(left, right, input_.pattern);
  ViewParameters& view = taken_.emplace_back();
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const BoardCorners& one = eye == 0 ? left : right;
    view[eye] = parameters_of(one, input_.pattern, input_.width_px, input_.height_px);
    coverage_[eye].add(one, view[eye], input_.width_px, input_.height_px);
    state_.maps[eye] = coverage_[eye].map();
  }
  state_.bars = lesser(coverage_[0].bars(), coverage_[1].bars());
  state_.views = int(taken_.size());
  input_.views.push_back({std::to_string(state_.views), std::move(left), std::move(right)});
  // Views too few or too alike to determine the cameras are no error here: more will come.
  if (state_.views >= kMinBoardPairs) {
    if (auto made = calibrate(input_)) {
      newest_ = *std::move(made);
      // At kFaceMm, between the distances for which it was computed, along a straight line.
      constexpr double kPlace = (kFaceMm - kFirstDepthMm) / kDepthStepMm;
      constexpr auto kBelow = std::size_t(kPlace);
      constexpr double kShare = kPlace - double(kBelow);
      const auto& depth = newest_->quality.uncertainty.depth;
      state_.error_mm = (1 - kShare) * depth[kBelow].sigma_mm + kShare * depth[kBelow + 1].sigma_mm;
      state_.disagreeing = state_.views - newest_->quality.used;
    } else {
      CalibratorInput exchanged = input_;
      for (BoardView& board : exchanged.views) std::swap(board.left, board.right);
      swapped_ = calibrate(exchanged).has_value();
    }
  }
  given_up_.clear();
  aim();
  advise();
  return {};
}

void ViewCollector::pass(bool left_whole, bool right_whole) {
  RELIEVO_ASSERT(state_.verdict == PairVerdict::Taken);
  state_.verdict = left_whole    ? PairVerdict::RightMissesIt
                   : right_whole ? PairVerdict::LeftMissesIt
                                 : PairVerdict::NoBoard;
  advise();
}

// The next target, or the end.
void ViewCollector::aim() {
  guide_.forget();
  pairs_on_target_ = useless_pairs_ = 0;
  if (swapped_) return;
  const bool enough = state_.views >= options_.min_views;
  const bool goal = newest_ && state_.error_mm <= options_.goal_mm &&
                    newest_->quality.verdict != CalibrationVerdict::Refuse;
  if (enough && goal && state_.bars.least() >= options_.full_bar) state_.end = LiveEnd::GoalReached;
  else if (state_.views >= options_.max_views) state_.end = LiveEnd::Full;
  else if (newest_ && is_of_another_size(newest_->quality)) state_.end = LiveEnd::Plateau;
  std::optional<ViewPlan> plan;
  if (!state_.done() && newest_ &&
      planner_->update(input_, *newest_, state_.error_mm, taken_, coverage_, options_))
    plan = planner_->plan(given_up_);
  if (!state_.done() && enough && given_up_.empty()) state_.end = end_of(plan, goal, options_.plateau_gain);
  best_worth_ = plan ? plan->best_worth : 0;
  std::vector<BoardParameters> left;
  for (const auto& view : taken_) left.push_back(view[0]);
  target_ = plan && plan->best ? *plan->best : opening_view(left, given_up_);
  state_.wanted = state_.done() ? std::nullopt : target_.target.outlines;
}

Result<CalibratorOutput> ViewCollector::finish() const { return calibrate(input_); }

Result<LiveCalibration> LiveCalibration::begin(const BoardPattern& pattern, const LiveOptions& options,
                                               ThreadPool& pool) {
  RELIEVO_TRY(pattern.check());
  RELIEVO_TRY(options.check());
  return LiveCalibration(pattern, options, pool);
}

LiveCalibration::LiveCalibration(const BoardPattern& pattern, const LiveOptions& options, ThreadPool& pool)
    : pattern_(pattern),
      options_(options),
      pool_(&pool),
      tracker_{BoardTracker(pattern), BoardTracker(pattern)} {
  nothing_yet_.goal_mm = options.goal_mm;
}

void LiveCalibration::restart() {
  tracker_ = {BoardTracker(pattern_), BoardTracker(pattern_)};
  collector_.reset();
}

Result<void> LiveCalibration::look(const ImageView& left, const ImageView& right,
                                   std::chrono::nanoseconds at) {
  if (left.empty() || right.empty()) return invalid("a pair without pictures");
  if (left.width_px != right.width_px || left.height_px != right.height_px)
    return invalid("the two cameras give pictures of different sizes: set both to one mode");
  if (!collector_) {
    RELIEVO_TRY_ASSIGN(collector_, ViewCollector::begin(pattern_, left.width_px, left.height_px, options_));
  }
  const CalibratorInput& views = collector_->views();
  if (left.width_px != views.width_px || left.height_px != views.height_px)
    return invalid("pictures of another size than before: do not change the cameras' mode, or begin again");
  const std::array<ImageView, 2> pictures{left, right};
  auto seen =
      for_both<BoardDetection>(*pool_, [&](std::size_t eye) { return tracker_[eye].look(pictures[eye]); });
  for (const auto& one : seen)
    if (!one) return one.error();
  RELIEVO_TRY_ASSIGN(const bool wanted,
                     collector_->consider({{*std::move(seen[0]), *std::move(seen[1])}, at}));
  return wanted ? take(pictures) : Result<void>();
}

Result<void> LiveCalibration::take(const std::array<ImageView, 2>& pictures) {
  auto corners =
      for_both<BoardCorners>(*pool_, [&](std::size_t eye) { return tracker_[eye].refine(pictures[eye]); });
  if (!corners[0] || !corners[1]) {
    collector_->pass(corners[0].has_value(), corners[1].has_value());
    return corners[0] ? corners[1].error() : corners[0].error();
  }
  if (!corners[0]->empty() && !corners[1]->empty())
    return collector_->take(*std::move(corners[0]), *std::move(corners[1]));
  collector_->pass(!corners[0]->empty(), !corners[1]->empty());
  return {};
}

Result<CalibratorOutput> LiveCalibration::finish() const {
  if (!collector_) return Error{Errc::InvalidState, "no pair of pictures has come yet"};
  return collector_->finish();
}

}  // namespace relievo::pipeline
