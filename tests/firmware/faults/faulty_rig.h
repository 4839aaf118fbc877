// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaultyRig: the simulated rig, whose cameras, wire, clock and heat fail as the test says. Several in a row
// may use one simulated rig, which takes seconds to make its person. Thread: the faults any; the rest as
// Device.
#pragma once

#include <string.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "hal/clock.h"
#include "hal/device.h"
#include "hal/picture_file.h"

namespace relievo::test {

struct RigFaults {
  std::atomic<bool> lost{false};                  // the right camera
  std::atomic<bool> late{false};                  // the right camera's pictures
  std::atomic<bool> dark{false};                  // both
  std::atomic<bool> swapped{false};               // seen when they are opened again
  std::atomic<bool> silent{false}, stuck{false};  // the trigger's wire
  std::atomic<bool> hot{false};
  std::atomic<bool> slow{false};              // opening and pictures take their time, until they may go on
  std::atomic<std::int64_t> ahead_s{0};       // of the clock that counts time
  std::atomic<std::int64_t> wall_shift_s{0};  // of the date
  // Every left picture bears this mark at its upper edge, to be found again where it should not be: the
  // pixels that put_mark() makes of this number, and nowhere else. 0: none.
  std::atomic<std::uint64_t> mark{0};
  static constexpr std::size_t kMarkBytes = 48;
  // Both cameras see this instead, as large as their pictures; none: what is there.
  std::atomic<const hal::Picture*> sheet{nullptr};
  static void put_mark(std::uint64_t number, std::byte* to) {
    for (std::size_t i = 0; i < kMarkBytes; ++i) {
      number = number * 6364136223846793005U + 1442695040888963407U;
      to[i] = static_cast<std::byte>(number >> 56);
    }
  }
  void mend() {
    for (auto* fault : {&lost, &late, &dark, &swapped, &silent, &stuck, &hot, &slow}) fault->store(false);
    wall_shift_s.store(0);
  }
};

class ShiftedClock final : public hal::Clock {
 public:
  explicit ShiftedClock(const RigFaults& faults) : faults_(faults) {}
  hal::Instant now() const override { return real_.now() + ahead(); }
  std::chrono::seconds ahead() const { return std::chrono::seconds(faults_.ahead_s.load()); }
  std::chrono::system_clock::time_point wall_now() const override {
    return real_.wall_now() + std::chrono::seconds(faults_.wall_shift_s.load());
  }

 private:
  hal::MonotonicClock real_;
  const RigFaults& faults_;
};

class FaultyLine final : public hal::TriggerLine {
 public:
  FaultyLine(hal::TriggerLine& real, const RigFaults& faults, const hal::Clock& clock)
      : TriggerLine(clock), real_(real), faults_(faults) {}

 private:
  Result<void> do_pulse(std::chrono::microseconds width, hal::Light light) override {
    if (faults_.stuck.load()) return Error{Errc::IoFailed, "the wire cannot be driven, as the test says"};
    return faults_.silent.load() ? Result<void>() : real_.pulse(width, light);
  }
  hal::TriggerLine& real_;
  const RigFaults& faults_;
};

class FaultyCamera final : public hal::Camera {
 public:
  FaultyCamera(hal::Camera& real, const RigFaults& faults, const ShiftedClock& clock, bool right)
      : real_(real), faults_(faults), clock_(clock), right_(right) {}
  ~FaultyCamera() override { real_.close(); }
  std::string_view serial() const override { return second_ ? "R1" : "L1"; }

 private:
  Result<void> plugged() const {
    return right_ && faults_.lost.load() ? Result<void>(Error{Errc::Disconnected, "as the test says"})
                                         : Result<void>();
  }
  Result<void> do_open(const hal::CaptureMode& mode) override {
    while (faults_.slow.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    RELIEVO_TRY(plugged());
    second_ = right_ != faults_.swapped.load();
    real_.close();
    return real_.open(mode);
  }
  Result<void> do_start() override {
    RELIEVO_TRY(plugged());
    return real_.start();
  }
  void do_stop() override { real_.stop(); }
  void do_close() override { real_.close(); }
  Result<void> do_set_exposure(const hal::Exposure& exposure) override {
    return real_.set_exposure(exposure);
  }
  Result<hal::ExposureLimits> do_exposure_limits() const override { return real_.exposure_limits(); }
  Result<hal::Frame> do_next_frame(hal::Instant deadline) override {
    RELIEVO_TRY(plugged());
    // Also of a pulse that was given just before its wire broke.
    if ((right_ && faults_.late.load()) || faults_.slow.load() || faults_.silent.load() ||
        faults_.stuck.load()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return Error{Errc::Timeout, "as the test says"};
    }
    RELIEVO_TRY_ASSIGN(hal::Frame frame, real_.next_frame(deadline - clock_.ahead()));
    RELIEVO_TRY(plugged());
    const hal::Frame::Stamp stamp{frame.exposed_at() + clock_.ahead(), frame.sequence(), frame.damaged()};
    auto* lent = new Lent{std::move(frame), {}};
    hal::RawImage raw = lent->real.raw();
    lent->bytes.assign(raw.bytes, raw.bytes + raw.size_bytes);
    raw.bytes = lent->bytes.data();
    if (const hal::Picture* sheet = faults_.sheet.load()) lent->show(sheet->bytes);
    if (faults_.dark.load()) std::fill(lent->bytes.begin(), lent->bytes.end(), std::byte{2});
    if (const auto mark = faults_.mark.load(); mark != 0 && !right_)
      RigFaults::put_mark(mark, lent->bytes.data() + 3 * raw.stride_bytes + 30);
    return hal::Frame(
        raw, stamp, [](void* of, int) { delete static_cast<Lent*>(of); }, lent, 0);
  }
  // A driver's buffer, which whoever looks for what the product left does not look at.
  struct Lent {
    hal::Frame real;
    std::vector<std::byte> bytes;
    ~Lent() { explicit_bzero(bytes.data(), bytes.size()); }
    void show(const std::vector<std::byte>& picture) {
      if (picture.size() == bytes.size()) std::copy(picture.begin(), picture.end(), bytes.begin());
    }
  };

  hal::Camera& real_;
  const RigFaults& faults_;
  const ShiftedClock& clock_;
  bool right_, second_ = right_;
};

class FaultyRig : public hal::Device {
 public:
  FaultyRig(hal::Device& real, const RigFaults& faults, hal::RemovableMedia& media)
      : real_(real), faults_(faults), media_(media) {}
  std::string_view name() const override { return real_.name(); }
  hal::CaptureMode preferred_mode() const override { return real_.preferred_mode(); }
  hal::Camera& left() override { return left_; }
  hal::Camera& right() override { return right_; }
  hal::TriggerLine& trigger() override { return line_; }
  bool exposes_together() const override { return real_.exposes_together(); }
  bool is_live() const override { return real_.is_live(); }
  bool too_hot() const override { return faults_.hot.load(); }
  hal::RemovableMedia& media() override { return media_; }
  hal::Clock& clock() override { return clock_; }
  hal::Watchdog& watchdog() override { return real_.watchdog(); }

 private:
  hal::Device& real_;
  const RigFaults& faults_;
  hal::RemovableMedia& media_;
  ShiftedClock clock_{faults_};
  FaultyLine line_{real_.trigger(), faults_, clock_};
  FaultyCamera left_{real_.left(), faults_, clock_, false}, right_{real_.right(), faults_, clock_, true};
};

}  // namespace relievo::test
