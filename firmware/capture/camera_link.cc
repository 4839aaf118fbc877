// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/camera_link.h"

#include <algorithm>

#include "hal/raw/raw_image.h"

namespace relievo::firmware {

using hal::Camera;
using hal::Frame;

namespace {
const Error kAway{Errc::Disconnected, "the camera is away: check its plug; it is tried again by itself"};
}  // namespace

Result<void> CameraLink::run(const hal::CaptureMode& mode) {
  if (camera_.state() == Camera::State::Closed) {
    RELIEVO_TRY(camera_.open(mode));
    ++opened_;
  }
  if (camera_.state() == Camera::State::Idle) {
    last_.reset();  // a stream counts from its own beginning
    RELIEVO_TRY(camera_.start());
  }
  return {};
}

Result<void> CameraLink::start(const hal::CaptureMode& mode) {
  if (!gone()) return run(mode);
  if (clock_.now() < due_) return kAway;
  if (const Result<void> back = run(mode); !back) {
    camera_.close();
    ++counts_.refused;
    wait_ = std::min(2 * wait_, budget::kCameraRetryMost);
    due_ = clock_.now() + wait_;
    return back;
  }
  ++counts_.returned;
  wait_ = budget::kCameraRetryFirst;
  gone_.store(false, std::memory_order_relaxed);
  return {};
}

void CameraLink::stop() { camera_.stop(); }

void CameraLink::restart() {
  if (camera_.state() == Camera::State::Closed) return;
  camera_.stop();
  last_.reset();
  if (!camera_.start()) lose();
}

void CameraLink::lose() {
  camera_.close();
  ++counts_.vanished;
  wait_ = budget::kCameraRetryFirst;
  due_ = clock_.now() + wait_;
  gone_.store(true, std::memory_order_relaxed);
}

// Waits in short slices, so that a cancelled person does not wait for a camera.
Result<Frame> CameraLink::wait(hal::Instant deadline, const std::atomic<bool>& cancelled) {
  for (;;) {
    if (cancelled.load(std::memory_order_relaxed)) return Error{Errc::Cancelled, "the capture was cancelled"};
    const hal::Instant slice = std::min(deadline, clock_.now() + budget::kTick);
    Result<Frame> frame = camera_.next_frame(slice);
    if (frame || frame.error().code != Errc::Timeout) return frame;
    if (clock_.now() >= deadline) return frame;
  }
}

CameraLink::Verdict CameraLink::judge(const Frame& frame, hal::Instant asked) {
  const std::uint32_t step = last_ ? frame.sequence() - *last_ : 1;  // wraps with the counter
  const bool backwards = step > 0x8000'0000U;
  if (step == 0) {
    ++counts_.duplicate;
    return Verdict::Skip;
  }
  last_ = frame.sequence();
  if (!backwards) counts_.lost += step - 1;
  if (backwards || frame.exposed_at() + budget::kStampSlack < asked) {
    ++counts_.late;
    return Verdict::Skip;
  }
  if (frame.damaged()) {
    ++counts_.damaged;
    return Verdict::Refuse;
  }
  if (hal::is_short(frame.raw())) {
    ++counts_.too_short;
    return Verdict::Refuse;
  }
  return Verdict::Take;
}

Result<Frame> CameraLink::next(hal::Instant asked, hal::Instant deadline,
                               const std::atomic<bool>& cancelled) {
  if (gone()) return kAway;
  for (;;) {
    Result<Frame> frame = wait(deadline, cancelled);
    if (!frame) {
      if (frame.error().code == Errc::Timeout) ++counts_.missing;
      if (frame.error().code == Errc::Disconnected) lose();
      return frame;
    }
    switch (judge(*frame, asked)) {
      case Verdict::Take:
        ++counts_.frames;
        return frame;
      case Verdict::Refuse:
        return Error{Errc::IoFailed, "the camera's picture came damaged: check its cable"};
      case Verdict::Skip:
        // A camera that floods with old frames may not hold anybody past the deadline.
        if (clock_.now() >= deadline) {
          ++counts_.missing;
          return Error{Errc::Timeout,
                       "the camera gives only pictures from before the trigger: check its wire"};
        }
    }
  }
}

}  // namespace relievo::firmware
