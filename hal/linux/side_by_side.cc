// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/side_by_side.h"

#include <algorithm>

#include "hal/raw/raw_image.h"

namespace relievo::hal {

Result<void> SideBySide::open(const CaptureMode& mode) {
  if (device_.state() != Camera::State::Closed) return {};
  return device_.open({2 * mode.width_px, mode.height_px, mode.exposure});
}

void SideBySide::close(std::size_t side) {
  if (!dead_ && beside(side).state() != Camera::State::Closed) return;
  for (Shared& shared : pictures_) {
    shared.frame.reset();
    shared.lent = shared.waits = {};
  }
  device_.close();
  dead_ = false;
}

Result<void> SideBySide::start() {
  if (device_.state() == Camera::State::Closed)
    return Error{Errc::Disconnected, "the camera's other half has vanished: both are opened again"};
  if (device_.state() == Camera::State::Running) return {};
  return device_.start();
}

void SideBySide::stop(std::size_t side) {
  for (Shared& shared : pictures_) shared.waits[side] = false;
  tidy();
  if (beside(side).state() != Camera::State::Running) device_.stop();
}

void SideBySide::tidy() {
  for (Shared& shared : pictures_)
    if (!shared.lent[0] && !shared.lent[1] && !shared.waits[0] && !shared.waits[1]) shared.frame.reset();
}

Result<Frame> SideBySide::next(std::size_t side, Instant deadline) {
  const std::size_t other = 1 - side;
  const auto waiting = std::ranges::find_if(pictures_, [&](const Shared& s) { return s.waits[side]; });
  if (waiting != pictures_.end()) return lend(*waiting, side);
  const auto room = std::ranges::find_if(pictures_, [](const Shared& s) { return !s.frame; });
  if (room == pictures_.end())
    return Error{Errc::Timeout, "every picture of this camera is lent out; give a frame back"};
  if (device_.state() != Camera::State::Running)
    return Error{Errc::Disconnected, "the camera's other half has vanished: both are opened again"};
  auto taken = device_.next_frame(deadline);
  if (!taken) {
    dead_ = dead_ || taken.error().code == Errc::Disconnected;
    return taken;
  }
  // The other side gets the newest only.
  for (Shared& shared : pictures_) shared.waits[other] = false;
  tidy();
  room->frame.emplace(*std::move(taken));
  room->waits = {};
  room->waits[other] = beside(side).state() == Camera::State::Running;
  return lend(*room, side);
}

Result<Frame> SideBySide::lend(Shared& shared, std::size_t side) {
  const RawImage& whole = shared.frame->raw();
  shared.waits[side] = false;
  shared.lent[side] = true;
  RawImage half = whole;
  half.width_px = whole.width_px / 2;
  const std::size_t row = raw_row_bytes(whole.format.coding, half.width_px);
  half.bytes += side * row;
  half.size_bytes -= std::min(half.size_bytes, side * row);
  const auto slot = int(kSides * std::size_t(&shared - pictures_.data()) + side);
  Frame frame(half, {shared.frame->exposed_at(), shared.frame->sequence(), shared.frame->damaged()},
              &SideBySide::give_back, this, slot);
  if (whole.format.coding == RawCoding::Mjpeg)
    return Error{Errc::Unsupported,
                 "motion JPEG of both views side by side cannot be halved: choose another format"};
  // A row of the left half must end where the right half's begins.
  if (2 * row != raw_row_bytes(whole.format.coding, whole.width_px))
    return Error{Errc::Unsupported,
                 "this width cannot be halved in the camera's format: choose another mode"};
  return frame;
}

void SideBySide::give_back(void* owner, int slot) {
  auto* both = static_cast<SideBySide*>(owner);
  both->pictures_[std::size_t(slot) / kSides].lent[std::size_t(slot) % kSides] = false;
  both->tidy();
}

}  // namespace relievo::hal
