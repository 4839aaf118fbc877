// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "pipeline/calibrate/live/live_state.h"

namespace relievo::pipeline {
namespace {

// In the order of LiveAdvice.
constexpr std::array kAdviceNames{"show the board",
                                  "the left camera does not see it whole",
                                  "the right camera does not see it whole",
                                  "hold still",
                                  "too blurred",
                                  "closer",
                                  "farther",
                                  "left",
                                  "right",
                                  "up",
                                  "down",
                                  "tilt left",
                                  "tilt right",
                                  "tilt forward",
                                  "tilt back",
                                  "turn clockwise",
                                  "turn counterclockwise",
                                  "already have this view",
                                  "exchange the cameras",
                                  "done"};
static_assert(kAdviceNames.size() == std::size_t(LiveAdvice::Done) + 1);

// In the order of PairVerdict.
constexpr std::array kVerdictNames{"taken",   "no board", "not whole in left", "not whole in right",
                                   "moving",  "blurred",  "already have",      "cameras swapped",
                                   "finished"};
static_assert(kVerdictNames.size() == std::size_t(PairVerdict::Finished) + 1);

// In the order of LiveEnd.
constexpr std::array kEndNames{"not yet", "goal reached", "more views would not help",
                               "as many views as allowed"};
static_assert(kEndNames.size() == std::size_t(LiveEnd::Full) + 1);

}  // namespace

const char* name_of(LiveAdvice advice) { return kAdviceNames[std::size_t(advice)]; }

std::string words_of(std::span<const LiveAdvice> way) {
  const auto holds = [&](LiveAdvice one) { return std::ranges::find(way, one) != way.end(); };
  const bool upper = holds(LiveAdvice::Up);
  const bool left = holds(LiveAdvice::Left);
  const bool corner = (upper || holds(LiveAdvice::Down)) && (left || holds(LiveAdvice::Right));
  bool corner_said = false;
  std::string words;
  for (const LiveAdvice one : way) {
    const bool aside = one == LiveAdvice::Left || one == LiveAdvice::Right || one == LiveAdvice::Up ||
                       one == LiveAdvice::Down;
    if (aside && corner && corner_said) continue;
    if (!words.empty()) words += ", ";
    if (aside && corner) words += std::string(upper ? "upper " : "lower ") + (left ? "left" : "right");
    else words += name_of(one);
    corner_said = corner_said || aside;
  }
  return words;
}

const char* name_of(PairVerdict verdict) { return kVerdictNames[std::size_t(verdict)]; }

const char* name_of(LiveEnd end) { return kEndNames[std::size_t(end)]; }

}  // namespace relievo::pipeline
