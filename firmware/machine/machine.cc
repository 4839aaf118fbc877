// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/machine/machine.h"

#include "firmware/base/budget.h"

namespace relievo::firmware {
namespace {

struct StateInfo {
  std::string_view name;
  std::optional<std::chrono::milliseconds> limit;
};
// In the order of State.
constexpr std::array<StateInfo, std::size_t(State::Count)> kStates{{{"SelfTest", budget::kSelfTestLimit},
                                                                    {"Idle", std::nullopt},
                                                                    {"Calibrate", budget::kCalibrateLimit},
                                                                    {"Position", budget::kPositionLimit},
                                                                    {"Capture", budget::kCaptureLimit},
                                                                    {"Turn", budget::kTurnLimit},
                                                                    {"Match", budget::kStageLimit},
                                                                    {"Reconstruct", budget::kStageLimit},
                                                                    {"Mesh", budget::kStageLimit},
                                                                    {"Texture", budget::kStageLimit},
                                                                    {"Assemble", budget::kStageLimit},
                                                                    {"Fuse", budget::kFuseLimit},
                                                                    {"Review", budget::kReviewLimit},
                                                                    {"Store", budget::kStoreLimit},
                                                                    {"Export", budget::kExportLimit},
                                                                    {"Staff", budget::kStaffLimit},
                                                                    {"Fault", budget::kFaultRetry}}};
static_assert(!kStates.back().name.empty());

}  // namespace

std::string_view name_of(State state) {
  return state < State::Count ? kStates[std::size_t(state)].name : "?";
}

std::optional<std::chrono::milliseconds> limit_of(State state) {
  return state < State::Count ? kStates[std::size_t(state)].limit : std::nullopt;
}

std::optional<Transition> Machine::handle(Event event, hal::Instant now) {
  const std::optional<State> to = next(state_, event);
  if (!to) return std::nullopt;
  const Transition change{state_, event, *to};
  state_ = *to;
  entered_ = now;
  return change;
}

void Machine::renew(hal::Instant now) {
  if (state_ == State::Position || state_ == State::Review || state_ == State::Staff ||
      state_ == State::Export)
    entered_ = now;
}

bool Machine::limit_reached(hal::Instant now) const {
  const auto limit = limit_of(state_);
  return limit && now - entered_ >= *limit;
}

std::optional<Transition> Machine::tick(hal::Instant now) {
  if (!limit_reached(now)) return std::nullopt;
  return handle(Event::Timeout, now);
}

}  // namespace relievo::firmware
