// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PlayedDevice: two cameras that show one flat picture, with faults and a clock as the test says. Both
// expose when they are pulsed. The PlayedWorld is the test's and outlives the device.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "hal/clock.h"
#include "hal/device.h"

namespace relievo::test {

struct PlayedWorld {
  std::atomic<bool> pulled{false};            // both cameras' plugs
  std::atomic<std::int64_t> wall_shift_s{0};  // of the wall clock
  std::atomic<std::int64_t> ahead_s{0};       // of the clock that counts time
};

class PlayedClock final : public hal::Clock {
 public:
  explicit PlayedClock(const PlayedWorld& world) : world_(world) {}
  hal::Instant now() const override { return real_.now() + std::chrono::seconds(world_.ahead_s.load()); }
  std::chrono::system_clock::time_point wall_now() const override {
    return real_.wall_now() + std::chrono::seconds(world_.wall_shift_s.load());
  }

 private:
  hal::MonotonicClock real_;
  const PlayedWorld& world_;
};

class PlayedLine final : public hal::TriggerLine {
 public:
  explicit PlayedLine(const hal::Clock& clock) : TriggerLine(clock), clock_(clock) {}
  hal::Instant pulsed_at;

 private:
  Result<void> do_pulse(std::chrono::microseconds, hal::Light) override {
    pulsed_at = clock_.now();
    return {};
  }
  const hal::Clock& clock_;
};

class PlayedCamera final : public hal::Camera {
 public:
  PlayedCamera(const PlayedWorld& world, const hal::Instant& pulsed_at, int width_px, int height_px)
      : world_(world),
        pulsed_at_(pulsed_at),
        width_px_(width_px),
        height_px_(height_px),
        pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), std::byte{0x5A}) {}
  std::deque<Errc> errors;  // one a picture, then pictures
  Result<void> on_start{};
  std::string number;  // serial; changed while it is unplugged
  std::string_view serial() const override { return number; }
  std::atomic<bool> held{false};  // it has been pulsed and its picture does not come

 private:
  Result<void> plugged() const {
    return world_.pulled.load() ? Result<void>(Error{Errc::Disconnected, "as the test says"}) : on_start;
  }
  Result<void> do_open(const hal::CaptureMode&) override { return plugged(); }
  Result<void> do_start() override { return plugged(); }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant) override {
    if (world_.pulled.load()) return Error{Errc::Disconnected, "as the test says"};
    if (held.load()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return Error{Errc::Timeout, "as the test says"};
    }
    if (!errors.empty()) {
      const Errc code = errors.front();
      errors.pop_front();
      return Error{code, "as the test says"};
    }
    return hal::Frame(
        {pixels_.data(), pixels_.size(), width_px_, height_px_, width_px_, {}}, {pulsed_at_, ++sequence_},
        [](void*, int) {}, this, 0);
  }
  const PlayedWorld& world_;
  const hal::Instant& pulsed_at_;
  int width_px_, height_px_;
  std::vector<std::byte> pixels_;
  std::uint32_t sequence_ = 0;
};

class PlayedDevice final : public hal::Device, hal::RemovableMedia, hal::Watchdog {
 public:
  PlayedDevice(const PlayedWorld& world, int width_px, int height_px)
      : time(world),
        left_camera(world, line.pulsed_at, width_px, height_px),
        right_camera(world, line.pulsed_at, width_px, height_px),
        mode_{width_px, height_px, std::chrono::microseconds(1)} {}
  PlayedClock time;
  PlayedLine line{time};
  PlayedCamera left_camera, right_camera;
  int kicks = 0;
  std::string_view name() const override { return "played"; }
  hal::CaptureMode preferred_mode() const override { return mode_; }
  hal::Camera& left() override { return left_camera; }
  hal::Camera& right() override { return right_camera; }
  hal::TriggerLine& trigger() override { return line; }
  bool is_live() const override { return false; }
  hal::RemovableMedia& media() override { return *this; }
  hal::Clock& clock() override { return time; }
  hal::Watchdog& watchdog() override { return *this; }

 private:
  std::optional<std::filesystem::path> current() override { return std::nullopt; }
  Result<void> flush_and_eject() override { return {}; }
  void kick() override { ++kicks; }
  hal::CaptureMode mode_;
};

}  // namespace relievo::test
