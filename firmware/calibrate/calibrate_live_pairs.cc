// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_live_pairs.h"

#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/base/budget.h"
#include "firmware/base/interrupt.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/capture/stereo_grabber.h"

namespace relievo::firmware {
namespace {

constexpr std::chrono::milliseconds kPeriod{100};  // of a folder's pairs
constexpr std::string_view kFolder = "folder:";

class DevicePairs final : public LivePairs {
 public:
  // most: pairs; shown: how often each is.
  DevicePairs(std::unique_ptr<hal::Device> device, int most, int shown, bool timed)
      : device_(std::move(device)),
        memory_(budget::kStereoSlotBytes),
        slot_(memory_),
        grabber_(*device_),
        most_(most),
        shown_(shown),
        timed_(timed) {}

  Result<std::optional<LivePair>> next(const pipeline::LiveState&) override {
    if (count_ == 0) RELIEVO_TRY(grabber_.start(device_->preferred_mode()));
    if (count_ / shown_ == most_) return std::optional<LivePair>();
    if (count_ % shown_ == 0) {
      RELIEVO_TRY_ASSIGN(frame_, grabber_.grab(slot_, interrupted()));
    }
    ++count_;
    const std::chrono::nanoseconds at = timed_ ? device_->clock().now().time_since_epoch() : count_ * kPeriod;
    return std::optional<LivePair>({frame_.left, frame_.right, at});
  }
  pipeline::RigCameras cameras() const override { return grabber_.cameras(); }

 private:
  std::unique_ptr<hal::Device> device_;
  std::vector<std::byte> memory_;
  StereoSlot slot_;
  StereoGrabber grabber_;
  pipeline::StereoFrame frame_;
  int most_;
  int shown_;
  bool timed_;
  int count_ = 0;
};

}  // namespace

Result<std::unique_ptr<LivePairs>> make_device_pairs(std::unique_ptr<hal::Device> device,
                                                     std::string_view name) {
  int most = std::numeric_limits<int>::max();
  int shown = 1;
  const bool folder = name.starts_with(kFolder);
  if (folder) {
    const Path pictures = name.substr(kFolder.size());
    RELIEVO_TRY_ASSIGN(const auto pairs, find_picture_pairs(pictures));
    most = static_cast<int>(pairs.size());
    std::error_code error;
    if (!std::filesystem::exists(pictures / "capture.json", error)) shown = 2;
  }
  return std::unique_ptr<LivePairs>(std::make_unique<DevicePairs>(std::move(device), most, shown, !folder));
}

}  // namespace relievo::firmware
