// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ExposureControl: one exposure for both cameras, metered on the face, and held for the shot.
//
//   Metering --step() says the light is right, or no exposure makes it better--> Settled --lock()--> Locked
//      ^                                                  | the light changes                          |
//      +--------------------------------------------------+--------------------- unlock() ------------+
//
// The camera that wants less light counts, so that neither burns out. Exposure time before gain: gain is
// noise; but no longer than kLongestExposure, since a face moves. Cameras without the controls are left as
// they are. Errors: what the cameras say; after one the control is Metering. Thread: capture.
#pragma once

#include <chrono>
#include <cstdint>

#include "firmware/capture/face_light.h"
#include "hal/base/result.h"
#include "hal/camera.h"

namespace relievo::firmware {

// What the brightest twentieth and the brightest hundredth of the face are to reach at the most, and how
// near, as a share, is near enough. Skin shines: without the second, highlights would burn out.
inline constexpr double kBrightTarget = 0.72;
inline constexpr double kHighlightTarget = 0.92;
inline constexpr double kLightTolerance = 0.08;
inline constexpr hal::Exposure kFirstExposure{std::chrono::milliseconds{4},
                                              1};  // until the light has been measured

// Where both cameras can go.
hal::ExposureLimits common_limits(const hal::ExposureLimits& a, const hal::ExposureLimits& b);
// The next exposure to try, within the limits; the same one where the light is right already.
hal::Exposure next_exposure(const hal::Exposure& now, const FaceLight& light,
                            const hal::ExposureLimits& limits);

class ExposureControl {
 public:
  enum class State : std::uint8_t { Metering, Settled, Locked, Fixed };  // Fixed: the cameras cannot be set

  ExposureControl(hal::Camera& left, hal::Camera& right) : left_(left), right_(right) {}

  // Sets both to the same exposure, within their limits. Once, when the cameras are open.
  Result<void> begin(const hal::Exposure& first);
  // With the light of the newest pair, exposed with exposure().
  Result<void> step(const FaceLight& left, const FaceLight& right);
  // For the shot: step() changes nothing until unlock(). InvalidState while Metering.
  Result<void> lock();
  void unlock() {
    if (state_ == State::Locked) state_ = State::Settled;
  }
  State state() const { return state_; }
  const hal::Exposure& exposure() const { return exposure_; }

 private:
  Result<void> set_both(const hal::Exposure& exposure);

  hal::Camera& left_;
  hal::Camera& right_;
  State state_ = State::Metering;
  hal::Exposure exposure_;
  hal::ExposureLimits limits_;
};

}  // namespace relievo::firmware
