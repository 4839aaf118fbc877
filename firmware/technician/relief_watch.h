// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReliefWatch: the relief the gate judges by, of pairs that somebody at the cameras looks at: where the rig
// sees depth and where it does not. The session's memory may be the worker's meanwhile, so it takes its own
// (kOutputBytes, kScratchBytes) with the first pair and gives it back with forget(). Thread: one at a time.
// Errors of look(): InvalidState (no calibration), those of LiveRelief, OutOfMemory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/jobs/job_thread.h"
#include "hal/base/image_view.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

class ReliefWatch {
 public:
  static constexpr std::size_t kOutputBytes = std::size_t{4} << 20,
                               kScratchBytes = std::size_t{64} << 20;  // touched: 1 MB and 27 MB

  ReliefWatch();
  ~ReliefWatch();
  ReliefWatch(const ReliefWatch&) = delete;
  ReliefWatch& operator=(const ReliefWatch&) = delete;
  // Null: there is none.
  void use(const pipeline::StereoCalibration* calibration);
  // Grey8, near is bright, black is unknown; valid until the next look() or forget().
  Result<ImageView> look(const pipeline::StereoFrame& frame, JobControl& control);
  // Wipes and gives back.
  void forget();

 private:
  struct Room;
  std::optional<pipeline::StereoCalibration> calibration_;
  std::unique_ptr<Room> room_;
  std::vector<std::uint8_t> grey_;
};

}  // namespace relievo::firmware
