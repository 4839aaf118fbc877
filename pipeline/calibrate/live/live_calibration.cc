// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/live_calibration.h"

#include <utility>

namespace relievo::pipeline {
namespace {

// One camera a thread.
template <typename T, typename Work>
std::array<Result<T>, 2> for_both(ThreadPool& pool, const Work& work) {
  std::array<Result<T>, 2> done{T{}, T{}};
  pool.for_each_band(2, 2, [&](int begin, int end, int) {
    for (int eye = begin; eye < end; ++eye) done[std::size_t(eye)] = work(std::size_t(eye));
  });
  return done;
}

Result<void> check_sizes(const ImageView& left, const ImageView& right) {
  if (left.empty() || right.empty()) return Error{Errc::InvalidInput, "a pair without pictures"};
  if (left.width_px != right.width_px || left.height_px != right.height_px)
    return Error{Errc::InvalidInput,
                 "the two cameras give pictures of different sizes: set both to one mode"};
  return {};
}

}  // namespace

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
  RELIEVO_TRY(check_sizes(left, right));
  if (!collector_) {
    RELIEVO_TRY_ASSIGN(ViewCollector collector,
                       ViewCollector::begin(pattern_, left.width_px, left.height_px, options_));
    collector_ = std::make_unique<ViewCollector>(std::move(collector));
  }
  const CalibratorInput& views = collector_->views();
  if (left.width_px != views.width_px || left.height_px != views.height_px)
    return Error{Errc::InvalidInput,
                 "pictures of another size than before: do not change the cameras' mode, or begin again"};
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
