// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// face_light(): how a camera sees the face: how bright, how much of it is burnt out, how sharp. What the
// exposure is set by and what a hand at the lens looks at. Green stands for brightness in colour pictures.
// Errors: InvalidInput (no picture, or a box of which fewer than 16 x 16 pixels lie in it). Thread: any.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/camera.h"

namespace relievo::firmware {

// Brightness of a pixel, 0 to 255.
inline int level_of(const std::uint8_t* row, int x, PixelFormat format) {
  if (format == PixelFormat::Grey8) return row[x];
  return format == PixelFormat::Grey16 ? row[2 * x + 1] : row[3 * x + 1];  // the high byte; green
}

// Its red, green and blue.
inline std::array<std::uint8_t, 3> colour_of(const std::uint8_t* row, int x, PixelFormat format) {
  if (format == PixelFormat::Rgb8) return {row[3 * x], row[3 * x + 1], row[3 * x + 2]};
  const auto grey = std::uint8_t(level_of(row, x, format));
  return {grey, grey, grey};
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

// FocusPeaking: which places of a camera's picture are in focus, for a hand at the lens. An edge is in focus
// where its second difference is a large share of the contrast around it, however high that is, and far above
// the noise of places as bright. Memory stays from picture to picture. Thread: one at a time. Errors: none.

class FocusPeaking {
 public:
  // Colours the pixels of `shown` (Rgb8, as LiveFeed::fill() makes it of `picture`) in which an edge is in
  // focus. Gives the share of them: of the same scene the larger the better in focus.
  double mark(const ImageView& picture, std::uint8_t* shown_rgb, int shown_width_px, int shown_height_px);
  void wipe() { *this = {}; }  // the heap wipes what it takes back

  static constexpr std::array<std::uint8_t, 3> kColour{90, 255, 60};

 private:
  static constexpr int kBlock = 8;
  static constexpr std::size_t kLevels = 8;  // of brightness
  struct Block {
    float least = 255, most = 0, response = 0;  // of the smoothed picture; mean of the second differences
  };
  void smooth(const ImageView& picture);
  void look_at_blocks();
  void tell_noise();
  int response(int x, int y) const;  // 16ths of a grey level
  bool in_focus(int x, int y) const;

  int width_ = 0, height_ = 0, across_ = 0, down_ = 0;
  std::vector<std::uint16_t> smoothed_;  // 16ths of a grey level
  std::vector<Block> blocks_;
  std::array<float, kLevels> noise_{};  // mean second difference of plain places, by their brightness
  std::vector<float> sorted_;
};

}  // namespace relievo::firmware
