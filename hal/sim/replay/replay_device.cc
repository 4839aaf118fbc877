// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/replay/replay_device.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace relievo::hal {

void FolderMedia::plug(std::optional<std::filesystem::path> root) {
  const std::lock_guard lock(mutex_);
  root_ = std::move(root);
  ejected_.reset();
  taken_up_ = false;
}

std::optional<std::filesystem::path> FolderMedia::current() {
  const std::lock_guard lock(mutex_);
  std::error_code failed;
  if (root_ && std::filesystem::is_directory(*root_, failed)) return root_;
  taken_up_ = false;  // what comes there next was put there by a hand
  return std::nullopt;
}

Result<void> FolderMedia::flush_and_eject() {
  const std::lock_guard lock(mutex_);
  if (!root_) return Error{Errc::MediaMissing, "there is no stick to eject"};
  const int folder = ::open(root_->c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return Error{Errc::MediaMissing, "the stick is gone", errno}.at(root_->native());
  const int failed = ::syncfs(folder) == 0 ? 0 : errno;
  ::close(folder);
  if (failed != 0)
    return Error{Errc::IoFailed, "the stick could not be flushed; do not trust what was written", failed}.at(
        root_->native());
  ejected_ = std::exchange(root_, std::nullopt);
  taken_up_ = false;
  return {};
}

Result<void> FolderMedia::take_up_again() {
  const std::lock_guard lock(mutex_);
  std::error_code error;
  if (!ejected_ || !std::filesystem::is_directory(*ejected_, error))
    return Error{Errc::MediaMissing, "the stick is gone"};
  root_ = std::exchange(ejected_, std::nullopt);
  taken_up_ = true;
  return {};
}

bool FolderMedia::is_taken_up() {
  const std::lock_guard lock(mutex_);
  return taken_up_;
}

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
  while (slot < kBuffers && buffers_[std::size_t(slot)].lent) ++slot;
  if (slot == kBuffers)
    return Error{Errc::Timeout, "every buffer of this camera is lent out; give a frame back"};
  RELIEVO_TRY_ASSIGN(const SilentTrigger::Pulse pulse, trigger_.wait_after(seen_, deadline));
  seen_ = pulse.number;
  RELIEVO_TRY_ASSIGN(PairSource::Exposure exposure, source_.expose(side_, pulse.number));
  if (exposure.picture.width_px != only_mode_.width_px || exposure.picture.height_px != only_mode_.height_px)
    return invalid("this picture's size differs from the first one's");
  Buffer& buffer = buffers_[std::size_t(slot)];
  buffer.picture = std::move(exposure.picture);
  buffer.lent = true;
  return Frame(raw_of(buffer.picture.view()), {pulse.at + exposure.late, pulse.number},
               &ReplayCamera::give_back, this, slot);
}

void ReplayCamera::give_back(void* owner, int slot) {
  static_cast<ReplayCamera*>(owner)->buffers_[std::size_t(slot)].lent = false;
}

}  // namespace relievo::hal
