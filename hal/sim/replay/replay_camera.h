// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReplayCamera: a camera whose exposures come from a PairSource: files, or the simulated rig. One
// frame per trigger pulse, the same pulse for both cameras; three buffers, as a sensor driver has.
// Thread: capture.
#pragma once

#include <array>
#include <functional>

#include "hal/camera.h"
#include "hal/picture_file.h"
#include "hal/sim/replay/silent_trigger.h"

namespace relievo::hal {

// Makes the picture of exposure number `number` (from 1). Both cameras ask for each number.
class PairSource {
 public:
  enum class Side : std::uint8_t { Left, Right };
  struct Exposure {
    Picture picture;
    std::chrono::nanoseconds late{0};  // exposed this long after the pulse
  };
  virtual ~PairSource() = default;
  virtual Result<Exposure> expose(Side side, std::uint32_t number) = 0;
  // Only a simulated person can (hal/sim/device.h).
  virtual void turn_head(double /*yaw_deg*/) {}
};

class ReplayCamera : public Camera {
 public:
  ReplayCamera(PairSource& source, PairSource::Side side, SilentTrigger& trigger,
               const CaptureMode& only_mode)
      : source_(source), side_(side), trigger_(trigger), only_mode_(only_mode) {}

 private:
  static constexpr int kBuffers = 3;
  Result<void> do_open(const CaptureMode& mode) override;  // Unsupported: another size
  Result<void> do_start() override;
  Result<Frame> do_next_frame(Instant deadline) override;  // Timeout, what the source says
  void do_stop() override {}
  static void give_back(void* owner, int slot);

  struct Buffer {
    Picture picture;
    bool lent = false;
  };
  PairSource& source_;
  PairSource::Side side_;
  SilentTrigger& trigger_;
  CaptureMode only_mode_;
  std::uint32_t seen_ = 0;
  std::array<Buffer, kBuffers> buffers_;
};

}  // namespace relievo::hal
