// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Camera: one image sensor that exposes when the trigger line says so.
//
//   Closed --open()--> Idle --start()--> Running --stop()--> Idle
//                                           |
//                                       next_frame()
//
// The base class checks the state once, for every backend; a call out of turn
// returns Errc::InvalidState and names both. Backends implement do_*() only.
// Thread: capture.
#pragma once

#include <cstdint>
#include <utility>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/clock.h"

namespace relievo::hal {

struct CaptureMode {
  int width_px = 0;
  int height_px = 0;
  std::chrono::microseconds exposure{0};
};

// A borrowed sensor buffer. Returning it (by destruction) queues it again, so
// holding every Frame of a camera stops that camera.
class Frame {
 public:
  using Release = void (*)(void* owner, int slot);
  Frame(ImageView image, Instant exposed_at, std::uint32_t sequence,
        Release release, void* owner, int slot)
      : image_(image), exposed_at_(exposed_at), sequence_(sequence),
        release_(release), owner_(owner), slot_(slot) {}
  Frame(Frame&& other) noexcept
      : image_(other.image_), exposed_at_(other.exposed_at_),
        sequence_(other.sequence_), release_(std::exchange(other.release_, nullptr)),
        owner_(other.owner_), slot_(other.slot_) {}
  Frame& operator=(Frame&&) = delete;
  ~Frame() { if (release_ != nullptr) release_(owner_, slot_); }

  const ImageView& image() const { return image_; }
  Instant exposed_at() const { return exposed_at_; }
  std::uint32_t sequence() const { return sequence_; }

 private:
  ImageView image_;
  Instant exposed_at_;
  std::uint32_t sequence_;
  Release release_;
  void* owner_;
  int slot_;
};

class Camera {
 public:
  enum class State : std::uint8_t { Closed, Idle, Running };

  virtual ~Camera() = default;

  State state() const { return state_; }

  Result<void> open(const CaptureMode& mode) {
    if (state_ != State::Closed) return Error{Errc::InvalidState, "open() needs Closed"};
    RELIEVO_TRY(do_open(mode));
    state_ = State::Idle;
    return {};
  }
  Result<void> start() {
    if (state_ != State::Idle) return Error{Errc::InvalidState, "start() needs Idle"};
    RELIEVO_TRY(do_start());
    state_ = State::Running;
    return {};
  }
  // Waits for the next exposure until the deadline: Timeout, Disconnected.
  Result<Frame> next_frame(Instant deadline) {
    if (state_ != State::Running) return Error{Errc::InvalidState, "next_frame() needs Running"};
    return do_next_frame(deadline);
  }
  void stop() {
    if (state_ == State::Running) do_stop();
    if (state_ == State::Running) state_ = State::Idle;
  }

 private:
  virtual Result<void> do_open(const CaptureMode& mode) = 0;
  virtual Result<void> do_start() = 0;
  virtual Result<Frame> do_next_frame(Instant deadline) = 0;
  virtual void do_stop() = 0;

  State state_ = State::Closed;
};

}  // namespace relievo::hal
