// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// face_light(): how a camera sees the face: how bright, how much of it is burnt out, how sharp. What the
// exposure is set by and what a hand at the lens looks at. Green stands for brightness in colour pictures.
// Errors: InvalidInput (no picture, or a box of which fewer than 16 x 16 pixels lie in it). Thread: any.
#pragma once

#include <chrono>
#include <cstdint>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/camera.h"

namespace relievo::firmware {

// Brightness of a pixel, 0 to 255.
inline int level_of(const std::uint8_t* row, int x, PixelFormat format) {
  if (format == PixelFormat::Grey8) return row[x];
  return format == PixelFormat::Grey16 ? row[2 * x + 1] : row[3 * x + 1];  // the high byte; green
}

// Pixels; the part of it outside the picture is not looked at.
struct FaceBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};
// Where a face is expected when none has been found: the middle, half as wide and high as the picture.
FaceBox middle_box(const ImageView& view);

struct FaceLight {
  double mean = 0;       // 0 to 1, 1 is white
  double bright = 0;     // 95 of 100 pixels are darker
  double highlight = 0;  // 99 of 100
  double clipped = 0;    // the share that is white, or within 1 of 100 of it
  // The mean squared gradient over the squared deviation, a number a pixel squared: of the same scene the
  // larger the sharper, however bright (Tenenbaum's measure, after Pertuz, Puig, Garcia 2013, made free of
  // brightness). Between scenes it means nothing.
  double sharpness = 0;
};
Result<FaceLight> face_light(const ImageView& view, const FaceBox& box);

// For a hand at the lens: how sharp it is against the sharpest seen since reset(), 1 is the best.
class FocusHelp {
 public:
  double share_of_best(const FaceLight& light);
  void reset() { best_ = 0; }

 private:
  double best_ = 0;
};

// ExposureControl: one exposure for both cameras, metered on the face, and held for the shot.
//
//   Metering --step() says the light is right, or no exposure makes it better--> Settled --lock()--> Locked
//      ^                                                  | the light changes                          |
//      +--------------------------------------------------+--------------------- unlock() ------------+
//
// The camera that wants less light counts, so that neither burns out. Exposure time before gain: gain is
// noise; but no longer than kLongestExposure, since a face moves. Cameras without the controls are left as
// they are. Errors: what the cameras say; after one the control is Metering. Thread: capture.

// What the brightest twentieth and the brightest hundredth of the face are to reach at the most, and how
// near, as a share, is near enough. Skin shines: without the second, highlights would burn out.
inline constexpr double kBrightTarget = 0.72;
inline constexpr double kHighlightTarget = 0.92;
inline constexpr double kLightTolerance = 0.08;
inline constexpr hal::Exposure kFirstExposure{std::chrono::milliseconds{4}, 1};  // until it is measured

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
