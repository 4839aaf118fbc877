// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/turn_job.h"

#include <thread>

namespace relievo::firmware {
namespace {

constexpr std::size_t kReliefShare = 8;  // of the memory: an eighth for the reliefs, the rest to make them

}  // namespace

Result<void> TurnJob::run(JobControl& control) {
  const std::span<std::byte> block = session_.follow_block();
  Arena output(block.first(block.size() / kReliefShare)), scratch(block.subspan(block.size() / kReliefShare));
  const Result<void> done = judge_ == nullptr ? Result<void>() : follow(control, output, scratch);
  output.wipe();
  scratch.wipe();
  session_.sides().end();
  return done;
}

Result<void> TurnJob::follow(JobControl& control, Arena& output, Arena& scratch) {
  pipeline::StageContext context{output, scratch, alone_, control.progress, control.cancelled};
  RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
  RELIEVO_TRY_ASSIGN(const bool can_follow, judge_->begin_turn(front_, context));
  if (!can_follow) return {};
  const auto set = pose_.exposure().exposure().time;
  const auto shutter = set.count() > 0 ? set : kFirstExposure.time;
  hal::Instant last_side = device_.clock().now();
  while (!enough_.load() && session_.sides().count() < pipeline::kSides &&
         device_.clock().now() - last_side < budget::kTurnPatience) {
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the sides are no longer waited for"};
    output.reset();
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame,
                       grabber_.grab(session_.free_slot(), control.cancelled));
    session_.live().fill(frame.left);
    RELIEVO_TRY_ASSIGN(const TurnMeasurement seen,
                       judge_->look_turned(frame, device_.clock().now(), shutter, context));
    session_.live().fill_relief(seen.relief);
    session_.live().publish(seen.guidance);
    if (seen.take) {
      RELIEVO_TRY(take(frame, control));
      judge_->took(*seen.take);
      last_side = device_.clock().now();
    }
    std::this_thread::sleep_for(budget::kLivePause);
  }
  return {};
}

// The pair that was looked at, or with a lamp one more in its light.
Result<void> TurnJob::take(const pipeline::StereoFrame& seen, JobControl& control) {
  if (device_.shot_light() == hal::Light::Off) return session_.sides().add(seen);
  BurstOptions options;
  options.pairs = 1;
  options.light = device_.shot_light();
  StereoSlot& slot = session_.free_slot();
  RELIEVO_TRY_ASSIGN(const BurstResult lit, burst_.shoot(slot, slot, options, control.cancelled));
  return session_.sides().add(lit.frame);
}

}  // namespace relievo::firmware
