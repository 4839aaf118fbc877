// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What ViewCollector tells the person.
#include <algorithm>

#include "pipeline/calibrate/live/view_collector.h"

namespace relievo::pipeline {
namespace {

constexpr int kUselessPairs = 3;

}  // namespace

void ViewCollector::advise() {
  state_.how_far = 0;
  state_.way.clear();
  state_.advice = advice_for_verdict();
  // Not every person reaches every target; another one will do.
  const bool tries = state_.verdict != PairVerdict::NoBoard && state_.verdict != PairVerdict::Taken;
  if (tries && ++pairs_on_target_ > options_.patience_pairs) give_up_target();
}

LiveAdvice ViewCollector::advice_for_verdict() {
  if (phase_ == Phase::Done) return LiveAdvice::Done;
  if (phase_ == Phase::Swapped) return LiveAdvice::SwappedCameras;
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

}  // namespace relievo::pipeline
