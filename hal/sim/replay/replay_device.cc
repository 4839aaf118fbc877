// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/replay/replay_device.h"

namespace relievo::hal {

Result<void> SilentTrigger::do_pulse(std::chrono::microseconds, Light) {
  {
    const std::lock_guard lock(mutex_);
    last_ = {last_.number + 1, clock_.now()};
  }
  pulsed_.notify_all();
  return {};
}

// Polls the given clock rather than waiting on the machine's: with a ManualClock the deadline comes
// when the test says so.
Result<SilentTrigger::Pulse> SilentTrigger::wait_after(std::uint32_t after, Instant deadline) {
  std::unique_lock lock(mutex_);
  while (last_.number == after) {
    if (clock_.now() >= deadline) return Error{Errc::Timeout, "no trigger pulse came before the deadline"};
    pulsed_.wait_for(lock, std::chrono::milliseconds(2));
  }
  return last_;
}

std::uint32_t SilentTrigger::count() const {
  const std::lock_guard lock(mutex_);
  return last_.number;
}

Result<void> ReplayCamera::do_open(const CaptureMode& mode) {
  if (mode.width_px != only_mode_.width_px || mode.height_px != only_mode_.height_px)
    return Error{Errc::Unsupported, "this board's pictures have one size only; ask for its preferred mode"};
  return {};
}

Result<void> ReplayCamera::do_start() {
  seen_ = trigger_.count();  // pulses before the start exposed nothing
  return {};
}

Result<Frame> ReplayCamera::do_next_frame(Instant deadline) {
  int slot = 0;
  while (slot < kBuffers && buffers_[static_cast<std::size_t>(slot)].lent) ++slot;
  if (slot == kBuffers)
    return Error{Errc::Timeout, "every buffer of this camera is lent out; give a frame back"};
  RELIEVO_TRY_ASSIGN(const SilentTrigger::Pulse pulse, trigger_.wait_after(seen_, deadline));
  seen_ = pulse.number;
  RELIEVO_TRY_ASSIGN(PairSource::Exposure exposure, source_.expose(side_, pulse.number));
  if (exposure.picture.width_px != only_mode_.width_px || exposure.picture.height_px != only_mode_.height_px)
    return Error{Errc::InvalidInput, "this picture's size differs from the first one's"};
  Buffer& buffer = buffers_[static_cast<std::size_t>(slot)];
  buffer.picture = std::move(exposure.picture);
  buffer.lent = true;
  return Frame(raw_of(buffer.picture.view()), {pulse.at + exposure.late, pulse.number},
               &ReplayCamera::give_back, this, slot);
}

void ReplayCamera::give_back(void* owner, int slot) {
  static_cast<ReplayCamera*>(owner)->buffers_[static_cast<std::size_t>(slot)].lent = false;
}

}  // namespace relievo::hal
