// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReplayDevice: a whole appliance around one PairSource. The devices of device.h differ only in theirs.
#pragma once

#include <array>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/device.h"
#include "hal/picture_file.h"
#include "hal/removable_media.h"
#include "hal/trigger_line.h"

namespace relievo::hal {

// FolderMedia: a folder that plays the USB stick. plug() and unplug() are what a hand would do. Thread: any.
class FolderMedia final : public RemovableMedia {
 public:
  FolderMedia() = default;
  explicit FolderMedia(std::filesystem::path root) { plug(std::move(root)); }

  void plug(std::optional<std::filesystem::path> root);
  void unplug() { plug(std::nullopt); }

  std::optional<std::filesystem::path> current() override;  // nothing when unplugged or the folder is gone
  Result<void> flush_and_eject() override;                  // MediaMissing, IoFailed
  Result<void> take_up_again() override;                    // MediaMissing
  bool is_taken_up() override;

 private:
  std::mutex mutex_;
  std::optional<std::filesystem::path> root_, ejected_;
  bool taken_up_ = false;
};

// SilentTrigger: a trigger line without a wire. It counts pulses; cameras that hang on it expose
// once for every pulse since they last did.
// Thread: any.
class SilentTrigger final : public TriggerLine {
 public:
  using TriggerLine::TriggerLine;

  struct Pulse {
    std::uint32_t number = 0;  // counts from 1
    Instant at;
  };
  // The newest pulse after number `after`; waits for one until the deadline. Nothing: Timeout.
  Result<Pulse> wait_after(std::uint32_t after, Instant deadline);
  std::uint32_t count() const;

 private:
  Result<void> do_pulse(std::chrono::microseconds width, Light light) override;

  mutable std::mutex mutex_;
  std::condition_variable pulsed_;
  Pulse last_;
};

// Makes the picture of exposure number `number` (from 1). Both cameras ask for each number.
class PairSource {
 public:
  enum class Side : std::uint8_t { Left, Right };
  struct Exposure {
    Picture picture;
    std::chrono::nanoseconds late{0};  // exposed this long after the pulse
  };
  virtual ~PairSource() = default;
  virtual Result<Exposure> expose(Side side, std::uint32_t number) = 0;
  // Only a simulated person can (hal/sim/device.h).
  virtual void turn_head(double /*yaw_deg*/) {}
};

// A camera whose exposures come from a PairSource: files, or the simulated rig. One frame per trigger pulse,
// the same pulse for both cameras; three buffers, as a sensor driver has. Thread: capture.
class ReplayCamera : public Camera {
 public:
  ReplayCamera(PairSource& source, PairSource::Side side, SilentTrigger& trigger,
               const CaptureMode& only_mode)
      : source_(source), side_(side), trigger_(trigger), only_mode_(only_mode) {}

 private:
  static constexpr int kBuffers = 3;
  Result<void> do_open(const CaptureMode& mode) override;  // Unsupported: another size
  Result<void> do_start() override;
  Result<Frame> do_next_frame(Instant deadline) override;  // Timeout, what the source says
  void do_stop() override {}
  static void give_back(void* owner, int slot);

  struct Buffer {
    Picture picture;
    bool lent = false;
  };
  PairSource& source_;
  PairSource::Side side_;
  SilentTrigger& trigger_;
  CaptureMode only_mode_;
  std::uint32_t seen_ = 0;
  std::array<Buffer, kBuffers> buffers_;
};

class ReplayDevice final : public Device {
 public:
  // together: the pairs were exposed by one trigger.
  ReplayDevice(std::string_view name, std::unique_ptr<PairSource> source, const CaptureMode& mode,
               bool together)
      : name_(name), source_(std::move(source)), mode_(mode), together_(together) {}

  std::string_view name() const override { return name_; }
  CaptureMode preferred_mode() const override { return mode_; }
  Camera& left() override { return left_; }
  Camera& right() override { return right_; }
  TriggerLine& trigger() override { return trigger_; }
  bool exposes_together() const override { return together_; }
  bool is_live() const override { return false; }
  RemovableMedia& media() override { return media_; }
  Clock& clock() override { return clock_; }
  Watchdog& watchdog() override { return watchdog_; }
  FolderMedia& folder_media() { return media_; }
  PairSource& source() { return *source_; }

 private:
  std::string_view name_;
  std::unique_ptr<PairSource> source_;
  CaptureMode mode_;
  bool together_;
  MonotonicClock clock_;
  SilentTrigger trigger_{clock_};
  FolderMedia media_;
  NullWatchdog watchdog_;
  ReplayCamera left_{*source_, PairSource::Side::Left, trigger_, mode_};
  ReplayCamera right_{*source_, PairSource::Side::Right, trigger_, mode_};
};

}  // namespace relievo::hal
