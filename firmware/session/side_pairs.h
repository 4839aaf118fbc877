// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SidePairs: the pairs that show a head from its sides, on their way from the capture thread to the worker,
// and the room where the worker keeps what each pose comes to. A pair waits in the room of its own pose;
// next() hands out a copy, so that the pose can be made there.
//
//   capture: add() ... end()        worker: next() until there is none; kept(pose)
//
// Fixed memory, of the session: wipe() leaves no pixel behind. Thread: as shown; wipe() and begin() main,
// while no job runs.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>

#include "firmware/base/budget.h"
#include "hal/base/arena.h"
#include "hal/base/result.h"
#include "pipeline/model/advice.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

class SidePairs {
 public:
  static constexpr std::size_t kPoses = pipeline::kSides + 1;  // the front's among them

  // A tenth for the copy, the rest for the poses, alike. Empty: no sides are taken.
  explicit SidePairs(std::span<std::byte> block);
  // A session's first side comes next.
  void begin();
  // OutOfMemory: pictures larger than the room; InvalidState: all sides are there.
  Result<void> add(const pipeline::StereoFrame& pair);
  // No more will come.
  void end();
  std::size_t count() const;
  // Waits for the next; none: no more come, or the job was cancelled. Valid until the next call.
  std::optional<pipeline::StereoFrame> next(const std::atomic<bool>& cancelled);
  // Room of a pose: 0 is the front's, then the sides' in their order.
  Arena& kept(std::size_t pose) { return kept_.at(pose); }
  void wipe();

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::span<std::byte> copy_;
  std::array<std::span<std::byte>, kPoses> rooms_;
  std::array<Arena, kPoses> kept_;
  std::array<pipeline::StereoFrame, pipeline::kSides> pairs_{};  // as they lie in the rooms
  std::array<std::size_t, pipeline::kSides> bytes_{};
  std::size_t added_ = 0, handed_out_ = 0;
  bool ended_ = false;
};

}  // namespace relievo::firmware
