// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two cameras on one trigger line that do at each pulse what a script says, and a clock that only
// moves with them: every fault a camera, cable or driver has, when the test wants it.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>

#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/trigger_line.h"

namespace relievo::firmware {

class HandClock final : public hal::Clock {
 public:
  hal::Instant time = hal::Instant{} + std::chrono::seconds(100);
  hal::Instant now() const override { return time; }
  std::chrono::system_clock::time_point wall_now() const override { return {}; }
};

// What a camera does at one pulse.
enum class Fault : std::uint8_t {
  None,
  Miss,   // it does not expose, nor count
  Lose,   // the driver drops the frame, and counts it
  Twice,  // the same frame is handed over two times
  Hold,   // the frame comes only after the next pulse
  Damage,
  Short,
  Apart,    // exposed 0.4 ms later than the other
  Restart,  // its sequence begins at 0 again
  Fail,     // the driver answers with an error once
  Vanish,   // unplugged
};

class ScriptedCamera final : public hal::Camera {
 public:
  static constexpr int kSide = 8;
  static constexpr int kStride = 16;  // more than the picture is wide, as sensors pad

  explicit ScriptedCamera(HandClock& clock) : clock_(clock) {}
  std::deque<Fault> script;       // one a pulse; afterwards None
  std::function<void()> on_wait;  // when it is asked for a frame
  std::function<void()> on_start;
  std::uint32_t sequence = 0;
  int width_px = kSide;
  int held = 0;
  int opens = 0;
  int starts = 0;
  bool plugged = true;

  // Every pixel says which pulse it was.
  void pulse(int number, hal::Instant at) {
    if (!plugged || state() != State::Running) return;
    Fault fault = Fault::None;
    if (!script.empty()) {
      fault = script.front();
      script.pop_front();
    }
    if (fault == Fault::Miss) return;
    if (fault == Fault::Restart) sequence = 0xFFFF'FFFF;
    ++sequence;
    if (fault == Fault::Vanish) plugged = false;
    if (fault == Fault::Lose || fault == Fault::Vanish) return;
    const auto late = std::chrono::microseconds(fault == Fault::Apart ? 400 : 0);
    const Waiting frame{fault, number, at + late, sequence};
    if (fault == Fault::Hold) {
      withheld_.push_back(frame);
      return;
    }
    queue_.insert(queue_.end(), withheld_.begin(), withheld_.end());
    withheld_.clear();
    queue_.push_back(frame);
    if (fault == Fault::Twice) queue_.push_back(frame);
  }

 private:
  struct Waiting {
    Fault fault;
    int number;
    hal::Instant at;
    std::uint32_t sequence;
  };
  Result<void> do_open(const hal::CaptureMode&) override {
    ++opens;
    if (!plugged) return Error{Errc::NotFound, "there is no camera"};
    return {};
  }
  Result<void> do_start() override {
    if (!plugged) return Error{Errc::Disconnected, "there is no camera"};
    ++starts;
    if (on_start) on_start();
    queue_.clear();
    withheld_.clear();
    return {};
  }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant deadline) override {
    if (on_wait) on_wait();
    if (!plugged) return Error{Errc::Disconnected, "the camera is gone: check its plug"};
    if (queue_.empty()) {
      clock_.time = std::max(clock_.time, deadline);
      return Error{Errc::Timeout, "no picture came"};
    }
    const Waiting waiting = queue_.front();
    queue_.pop_front();
    if (waiting.fault == Fault::Fail) return Error{Errc::IoFailed, "the driver reports an error"};
    ++held;
    pixels_.fill(std::byte(static_cast<unsigned char>(waiting.number)));
    hal::RawImage raw{pixels_.data(), pixels_.size(), width_px, kSide, kStride, {}};
    if (waiting.fault == Fault::Short) raw.size_bytes = kStride * kSide / 2;
    return hal::Frame(
        raw, {waiting.at, waiting.sequence, waiting.fault == Fault::Damage},
        [](void* owner, int) { --static_cast<ScriptedCamera*>(owner)->held; }, this, 0);
  }

  HandClock& clock_;
  std::array<std::byte, kStride * kSide> pixels_{};
  std::deque<Waiting> queue_, withheld_;
};

// A pulse exposes both cameras a moment later; reading out takes 20 ms.
class ScriptedLine final : public hal::TriggerLine {
 public:
  ScriptedLine(HandClock& clock, ScriptedCamera& left, ScriptedCamera& right)
      : TriggerLine(clock), clock_(clock), left_(left), right_(right) {}
  int pulses = 0;
  bool broken = false;
  bool lamp_on_it = false;
  bool lights_with_every_pulse() const override { return lamp_on_it; }

 private:
  Result<void> do_pulse(std::chrono::microseconds, hal::Light) override {
    if (broken) return Error{Errc::IoFailed, "the trigger line does not answer"};
    ++pulses;
    const hal::Instant exposed = clock_.time + std::chrono::microseconds(30);
    left_.pulse(pulses, exposed);
    right_.pulse(pulses, exposed + std::chrono::microseconds(10));
    clock_.time += std::chrono::milliseconds(20);
    return {};
  }
  HandClock& clock_;
  ScriptedCamera& left_;
  ScriptedCamera& right_;
};

}  // namespace relievo::firmware
