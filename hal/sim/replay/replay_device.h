// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReplayDevice: a whole appliance around one PairSource. The devices of device.h differ only in theirs.
#pragma once

#include <memory>
#include <optional>

#include "hal/device.h"
#include "hal/monotonic_clock.h"
#include "hal/sim/replay/folder_media.h"
#include "hal/sim/replay/null_watchdog.h"
#include "hal/sim/replay/replay_camera.h"
#include "hal/sim/replay/silent_trigger.h"

namespace relievo::hal {

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
