// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/machine/machine.h"

#include "firmware/base/budget.h"

namespace relievo::firmware {
namespace {

// In the order of State.
constexpr std::array<std::string_view, std::size_t(State::Count)> kStateNames{
    "SelfTest", "Idle",     "Calibrate", "Position", "Capture", "Turn",   "Match", "Reconstruct", "Mesh",
    "Texture",  "Assemble", "Fuse",      "Review",   "Store",   "Export", "Staff", "Fault"};
static_assert(!kStateNames.back().empty());

}  // namespace

std::string_view name_of(State state) { return state < State::Count ? kStateNames[std::size_t(state)] : "?"; }

std::optional<std::chrono::milliseconds> limit_of(State state) {
  switch (state) {
    case State::SelfTest: return budget::kSelfTestLimit;
    case State::Position: return budget::kPositionLimit;
    case State::Capture: return budget::kCaptureLimit;
    case State::Turn: return budget::kTurnLimit;
    case State::Fuse: return budget::kFuseLimit;
    case State::Match:
    case State::Reconstruct:
    case State::Mesh:
    case State::Texture:
    case State::Assemble: return budget::kStageLimit;
    case State::Review: return budget::kReviewLimit;
    case State::Store: return budget::kStoreLimit;
    case State::Export: return budget::kExportLimit;
    case State::Calibrate: return budget::kCalibrateLimit;
    case State::Staff: return budget::kStaffLimit;
    case State::Fault: return budget::kFaultRetry;
    case State::Idle:
    case State::Count: break;
  }
  return std::nullopt;
}

std::optional<Change> Machine::handle(Event event, hal::Instant now) {
  const std::optional<State> to = next(state_, event);
  if (!to) return std::nullopt;
  const Change change{state_, event, *to};
  state_ = *to;
  entered_ = now;
  return change;
}

void Machine::renew(hal::Instant now) {
  if (state_ == State::Position || state_ == State::Review || state_ == State::Staff) entered_ = now;
}

bool Machine::limit_reached(hal::Instant now) const {
  const auto limit = limit_of(state_);
  return limit && now - entered_ >= *limit;
}

std::optional<Change> Machine::tick(hal::Instant now) {
  if (!limit_reached(now)) return std::nullopt;
  return handle(Event::Timeout, now);
}

}  // namespace relievo::firmware
