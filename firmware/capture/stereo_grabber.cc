// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_grabber.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "firmware/budget.h"

namespace relievo::firmware {

using hal::Camera;
using hal::Frame;

Result<void> StereoGrabber::start(const hal::CaptureMode& mode) {
  for (Camera* camera : {&left_, &right_}) {
    if (camera->state() == Camera::State::Closed) RELIEVO_TRY(camera->open(mode));
    if (camera->state() == Camera::State::Idle) RELIEVO_TRY(camera->start());
  }
  return {};
}

void StereoGrabber::stop() {
  left_.stop();
  right_.stop();
}

Result<void> StereoGrabber::restart() {
  stop();
  RELIEVO_TRY(left_.start());
  return right_.start();
}

// Waits in short slices, so that a cancelled person does not wait for a camera.
Result<Frame> StereoGrabber::next(Camera& camera, hal::Instant deadline, const std::atomic<bool>& cancelled) {
  for (;;) {
    if (cancelled.load(std::memory_order_relaxed)) return Error{Errc::Cancelled, "the capture was cancelled"};
    const hal::Instant slice = std::min(deadline, clock_.now() + budget::kTick);
    Result<Frame> frame = camera.next_frame(slice);
    if (frame || frame.error().code != Errc::Timeout) return frame;
    if (clock_.now() >= deadline) return frame;
  }
}

Result<pipeline::StereoFrame> StereoGrabber::grab(StereoSlot& slot, const std::atomic<bool>& cancelled) {
  Result<pipeline::StereoFrame> pair = grab_once(slot, cancelled);
  // A restart that fails too changes nothing: the first reason is the one to tell.
  if (!pair && !restart()) stop();
  return pair;
}

Result<pipeline::StereoFrame> StereoGrabber::grab_once(StereoSlot& slot, const std::atomic<bool>& cancelled) {
  const hal::Instant deadline = clock_.now() + budget::kFrameWait;
  RELIEVO_TRY(trigger_.pulse(budget::kTriggerPulse));
  std::optional<Frame> left;
  std::optional<Frame> right;
  std::chrono::nanoseconds skew{0};
  for (;;) {
    if (!left) {
      RELIEVO_TRY_ASSIGN(Frame frame, next(left_, deadline, cancelled));
      left.emplace(std::move(frame));
    }
    if (!right) {
      RELIEVO_TRY_ASSIGN(Frame frame, next(right_, deadline, cancelled));
      right.emplace(std::move(frame));
    }
    skew = right->exposed_at() - left->exposed_at();
    if (std::chrono::abs(skew) <= budget::kMaxSkew) break;
    if (clock_.now() >= deadline) {
      return Error{Errc::Timeout, "the two cameras did not expose together: check the trigger wire"};
    }
    (skew.count() > 0 ? left : right).reset();  // the older one has lost its partner
  }
  if (left->image().width_px != right->image().width_px || left->image().height_px != right->image().height_px) {
    return Error{Errc::InvalidInput, "the two cameras give pictures of different sizes: set both to one mode"};
  }
  pipeline::StereoFrame pair;
  RELIEVO_TRY_ASSIGN(pair.left, slot.keep_left(left->image()));
  RELIEVO_TRY_ASSIGN(pair.right, slot.keep_right(right->image()));
  pair.sequence = left->sequence();
  pair.skew_ns = skew.count();
  return pair;
}

}  // namespace relievo::firmware
