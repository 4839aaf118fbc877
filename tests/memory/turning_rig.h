// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TurningRig: two cameras before somebody who turns the head as the page says. Time goes by with every
// picture, and when the test says so. Where the head truly stands is written into the first pixel of the left
// picture. Thread: comes() and time main, the cameras capture, say() any.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <compare>
#include <map>
#include <mutex>
#include <optional>

#include "hal/sim/replay/replay_device.h"
#include "pipeline/model/stereo_frame.h"
#include "tests/support/head_album.h"
#include "tests/support/manual_clock.h"
#include "tests/support/turning_person.h"

namespace relievo::test {

// Pictures of a few people at every half degree, each made when it is asked for and kept. Thread: any.
class TurningPictures {
 public:
  // Of the album's pictures: a head that moves is judged by pixels; and of them the middle, where the head
  // is.
  static constexpr int kEnlarged = 2, kAlbumWidthPx = 480, kWidthPx = 360, kHeightPx = 300;
  const pipeline::StereoCalibration& calibration() const { return calibration_; }
  struct Look {
    std::uint32_t person = 0;
    int half_degrees = 0;
    bool gone = false, company = false;
    auto operator<=>(const Look&) const = default;
  };
  // Two, that differ in their noise.
  const std::array<hal::sim::PicturePair, 2>& of(const Look& look);

 private:
  std::mutex mutex_;
  Album album_;
  std::map<Look, std::array<hal::sim::PicturePair, 2>> pictures_;
  pipeline::StereoCalibration calibration_ = enlarged(album_.calibration());
  static pipeline::StereoCalibration enlarged(pipeline::StereoCalibration of);
};

class TurningRig final : public hal::Device {
 public:
  // Between two pictures: a slow machine's. Before nobody nothing is missed.
  static constexpr double kLookS = 0.25, kEmptyLookS = 1;
  explicit TurningRig(TurningPictures& pictures) : source_(pictures, time) {}
  void comes(std::uint32_t person, const TurningPerson& manners) { source_.comes(person, manners); }
  void say(std::optional<pipeline::TurnAdvice> advice) { source_.said = advice; }
  // In the picture of a head: degrees; none: nobody is there.
  static std::optional<int> true_yaw_deg(const pipeline::StereoFrame& frame);

  std::string_view name() const override { return "turning"; }
  hal::CaptureMode preferred_mode() const override { return kMode; }
  hal::Camera& left() override { return left_; }
  hal::Camera& right() override { return right_; }
  hal::TriggerLine& trigger() override { return trigger_; }
  hal::RemovableMedia& media() override { return media_; }
  hal::Clock& clock() override { return time; }
  hal::Watchdog& watchdog() override { return watchdog_; }

  hal::ManualClock time;

 private:
  static constexpr hal::CaptureMode kMode{TurningPictures::kWidthPx * TurningPictures::kEnlarged,
                                          TurningPictures::kHeightPx* TurningPictures::kEnlarged,
                                          std::chrono::milliseconds(8)};
  class Source final : public hal::PairSource {
   public:
    Source(TurningPictures& pictures, hal::ManualClock& clock) : pictures_(pictures), clock_(clock) {}
    void comes(std::uint32_t person, const TurningPerson& manners) { person_ = person, manners_ = manners; }
    Result<Exposure> expose(Side side, std::uint32_t number) override;
    std::atomic<std::optional<pipeline::TurnAdvice>> said;

   private:
    TurningPictures& pictures_;
    hal::ManualClock& clock_;
    std::uint32_t person_ = 0, number_ = 0;
    TurningPerson manners_{TurningPerson::Kind::Willing, 0};
  };
  // Lit by 8 ms, as a kiosk in a dim hall.
  class Camera final : public hal::ReplayCamera {
   public:
    using ReplayCamera::ReplayCamera;

   private:
    Result<void> do_set_exposure(const hal::Exposure&) override { return {}; }
    Result<hal::ExposureLimits> do_exposure_limits() const override {
      return hal::ExposureLimits{{kMode.exposure, 1}, {kMode.exposure, 1}};
    }
  };
  Source source_;
  hal::SilentTrigger trigger_{time};
  hal::FolderMedia media_;
  hal::NullWatchdog watchdog_;
  Camera left_{source_, hal::PairSource::Side::Left, trigger_, kMode};
  Camera right_{source_, hal::PairSource::Side::Right, trigger_, kMode};
};

}  // namespace relievo::test
