// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CameraLink: one camera of the pair, kept alive. It drops frames that are late or came twice, refuses
// damaged and short ones, and opens a camera that has vanished again, each time after a longer wait.
//
//   New --start()--> Running --vanishes--> Lost --start() when due, it answers--> Running
//                                           |  ^
//                                           +--+ start(), it does not: the wait doubles, kCameraRetryMost at
//                                           most
//
// Thread: capture; gone() any.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

#include "firmware/base/budget.h"
#include "firmware/capture/grab_counts.h"
#include "hal/camera.h"
#include "hal/clock.h"

namespace relievo::firmware {

class CameraLink {
 public:
  CameraLink(hal::Camera& camera, const hal::Clock& clock, CameraCounts& counts)
      : camera_(camera), clock_(clock), counts_(counts) {}

  // Opens and starts what is not. What a camera that never ran says, or Disconnected: it is lost and
  // either not due yet or still away.
  Result<void> start(const hal::CaptureMode& mode);
  void stop();
  // Stops and starts the stream; a camera that does not start again counts as lost.
  void restart();
  // The next whole frame exposed at `asked` or later. Timeout, Cancelled, Disconnected (and it is lost),
  // IoFailed (the frame was damaged or short), what the camera says.
  Result<hal::Frame> next(hal::Instant asked, hal::Instant deadline, const std::atomic<bool>& cancelled);
  bool gone() const { return gone_.load(std::memory_order_relaxed); }
  hal::Instant due() const { return due_; }
  // How often the camera was opened: each time it may be another one.
  int opened() const { return opened_; }

 private:
  enum class Verdict : std::uint8_t { Take, Skip, Refuse };
  Result<hal::Frame> wait(hal::Instant deadline, const std::atomic<bool>& cancelled);
  Verdict judge(const hal::Frame& frame, hal::Instant asked);
  Result<void> run(const hal::CaptureMode& mode);
  void lose();

  hal::Camera& camera_;
  const hal::Clock& clock_;
  CameraCounts& counts_;
  std::atomic<bool> gone_{false};
  std::optional<std::uint32_t> last_;  // sequence number of this stream's newest frame
  hal::Instant due_;
  int opened_ = 0;
  std::chrono::milliseconds wait_ = budget::kCameraRetryFirst;
};

}  // namespace relievo::firmware
