// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Camera: one image sensor that exposes when the trigger line says so.
//
//   Closed --open()--> Idle --start()--> Running --stop()--> Idle --close()--> Closed
//                                           |
//                                       next_frame()
//
// The base class checks the state once, for every backend; a call out of turn returns Errc::InvalidState and
// names both. Backends implement do_*() only. A camera that has vanished is closed and opened again: nothing
// else brings it back. Thread: capture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "hal/base/result.h"
#include "hal/clock.h"
#include "hal/raw/raw_image.h"

namespace relievo::hal {

// Frame: a borrowed sensor buffer. Returning it (by destruction) queues it again, so holding every
// Frame of a camera stops that camera. Thread: capture.
class Frame {
 public:
  using Release = void (*)(void* owner, int slot);
  // exposed_at: when the sensor was exposed, as the driver's hardware time stamp says, on the machine's
  // own clock. sequence: counts exposures, also those the driver had to drop. damaged: the driver says
  // that bytes were lost on the way.
  struct Stamp {
    Instant exposed_at;
    std::uint32_t sequence = 0;
    bool damaged = false;
  };
  Frame(const RawImage& raw, const Stamp& stamp, Release release, void* owner, int slot)
      : raw_(raw), stamp_(stamp), lender_(owner, {release, slot}) {}

  const RawImage& raw() const { return raw_; }
  Instant exposed_at() const { return stamp_.exposed_at; }
  std::uint32_t sequence() const { return stamp_.sequence; }
  bool damaged() const { return stamp_.damaged; }

 private:
  struct GiveBack {
    Release release;
    int slot;
    void operator()(void* owner) const { release(owner, slot); }
  };
  RawImage raw_;
  Stamp stamp_;
  std::unique_ptr<void, GiveBack> lender_;
};

struct CaptureMode {
  int width_px = 0;
  int height_px = 0;
  std::chrono::microseconds exposure{0};
  std::size_t pixels() const { return std::size_t(width_px) * std::size_t(height_px); }
};

// How much light the sensor takes: both cameras of a pair get the same. Gain 1 is the sensor's own.
struct Exposure {
  std::chrono::microseconds time{0};
  double gain = 1;

  friend bool operator==(const Exposure&, const Exposure&) = default;
};
struct ExposureLimits {
  Exposure least;
  Exposure most;
};

class Camera {
 public:
  enum class State : std::uint8_t { Closed, Idle, Running };

  virtual ~Camera() = default;

  State state() const { return state_; }

  Result<void> open(const CaptureMode& mode) {
    if (state_ != State::Closed) return Error{Errc::InvalidState, "open() needs Closed"};
    RELIEVO_TRY(do_open(mode));
    exposure_ = {mode.exposure, 1};
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
    if (state_ != State::Running) return;
    do_stop();
    state_ = State::Idle;
  }
  void close() {
    stop();
    if (state_ == State::Idle) do_close();
    state_ = State::Closed;
  }
  // From the next exposure on; automatic exposure ends. Unsupported by a camera without the controls,
  // InvalidInput outside the limits.
  Result<void> set_exposure(const Exposure& exposure) {
    if (state_ == State::Closed) return Error{Errc::InvalidState, "set_exposure() needs Idle or Running"};
    RELIEVO_TRY(do_set_exposure(exposure));
    exposure_ = exposure;
    return {};
  }
  // As asked for last, by open() or since; no time: nobody has.
  const Exposure& exposure() const { return exposure_; }
  Result<ExposureLimits> exposure_limits() const {
    if (state_ == State::Closed) return Error{Errc::InvalidState, "exposure_limits() needs Idle or Running"};
    return do_exposure_limits();
  }
  // What tells this very camera from all others of its kind; empty where it does not say. After open().
  virtual std::string_view serial() const { return {}; }
  // The socket it is plugged in at, by a name that survives a reboot; empty where there is none.
  virtual std::string_view socket() const { return {}; }

 private:
  virtual Result<void> do_open(const CaptureMode& mode) = 0;
  virtual Result<void> do_start() = 0;
  virtual Result<Frame> do_next_frame(Instant deadline) = 0;
  virtual void do_stop() = 0;
  virtual void do_close() {}
  virtual Result<void> do_set_exposure(const Exposure&) {
    return Error{Errc::Unsupported, "this camera's exposure cannot be set"};
  }
  virtual Result<ExposureLimits> do_exposure_limits() const {
    return Error{Errc::Unsupported, "this camera's exposure cannot be set"};
  }

  State state_ = State::Closed;
  Exposure exposure_;
};

}  // namespace relievo::hal
