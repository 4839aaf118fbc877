// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/base/budget.h"

namespace relievo::firmware {
namespace {

constexpr int kLeastSide = 16;
constexpr int kWhiteFrom = 252;
constexpr double kBrightShare = 0.95;
constexpr double kHighlightShare = 0.99;

using std::chrono::microseconds;

// How much more light is wanted. What is burnt out does not say by how much it is too bright.
double factor_for(const FaceLight& light) {
  if (light.clipped > 0.05) return 0.4;
  const double factor = std::min(kBrightTarget / std::max(light.bright, 0.01),
                                 kHighlightTarget / std::max(light.highlight, 0.01));
  return std::clamp(light.highlight >= 0.995 ? std::min(factor, 0.85) : factor, 0.25, 4.0);
}

double light_taken(const hal::Exposure& e) { return double(e.time.count()) * e.gain; }

microseconds longest(const hal::ExposureLimits& limits) {
  return std::clamp(budget::kLongestExposure, limits.least.time, limits.most.time);
}

}  // namespace

FaceBox middle_box(const ImageView& view) {
  return {view.width_px / 4, view.height_px / 4, view.width_px / 2, view.height_px / 2};
}

Result<FaceLight> face_light(const ImageView& view, const FaceBox& box) {
  const int left = std::max(box.x_px, 0);
  const int top = std::max(box.y_px, 0);
  const int right = std::min(box.x_px + box.width_px, view.width_px);
  const int bottom = std::min(box.y_px + box.height_px, view.height_px);
  if (view.empty() || right - left < kLeastSide || bottom - top < kLeastSide)
    return Error{Errc::InvalidInput, "the face is not in the picture: its light cannot be measured"};
  std::array<long, 256> histogram{};
  double gradient = 0;
  for (int y = top; y < bottom; ++y) {
    const std::uint8_t* row = view.row(y);
    const std::uint8_t* below = view.row(std::min(y + 1, bottom - 1));
    for (int x = left; x < right; ++x) {
      const int here = level_of(row, x, view.format);
      ++histogram[std::size_t(here)];
      const int dx = level_of(row, std::min(x + 1, right - 1), view.format) - here;
      const int dy = level_of(below, x, view.format) - here;
      gradient += dx * dx + dy * dy;
    }
  }
  const double count = double(right - left) * (bottom - top);
  FaceLight light;
  double sum = 0;
  double squares = 0;
  double darker = 0;
  for (int v = 0; v < 256; ++v) {
    const auto n = double(histogram[std::size_t(v)]);
    sum += n * v;
    squares += n * v * v;
    if (n > 0 && darker < kBrightShare * count) light.bright = v / 255.0;
    if (n > 0 && darker < kHighlightShare * count) light.highlight = v / 255.0;
    darker += n;
    if (v >= kWhiteFrom) light.clipped += n / count;
  }
  const double mean = sum / count;
  const double variance = squares / count - mean * mean;
  light.mean = mean / 255;
  light.sharpness = variance > 0 ? gradient / count / variance : 0;
  return light;
}

double FocusHelp::share_of_best(const FaceLight& light) {
  best_ = std::max(best_, light.sharpness);
  return best_ > 0 ? light.sharpness / best_ : 0;
}

hal::ExposureLimits common_limits(const hal::ExposureLimits& a, const hal::ExposureLimits& b) {
  return {{std::max(a.least.time, b.least.time), std::max(a.least.gain, b.least.gain)},
          {std::min(a.most.time, b.most.time), std::min(a.most.gain, b.most.gain)}};
}

hal::Exposure next_exposure(const hal::Exposure& now, const FaceLight& light,
                            const hal::ExposureLimits& limits) {
  const double factor = factor_for(light);
  if (std::abs(factor - 1) <= kLightTolerance) return now;
  const double wanted_us = light_taken(now) * factor;
  const double least_us = double(limits.least.time.count());
  const double most_us = double(longest(limits).count());
  hal::Exposure next;
  next.time = microseconds(std::lround(std::clamp(wanted_us / limits.least.gain, least_us, most_us)));
  next.gain = std::clamp(wanted_us / double(next.time.count()), limits.least.gain, limits.most.gain);
  return next;
}

Result<void> ExposureControl::set_both(const hal::Exposure& exposure) {
  state_ = State::Metering;
  RELIEVO_TRY(left_.set_exposure(exposure));
  RELIEVO_TRY(right_.set_exposure(exposure));
  exposure_ = exposure;
  return {};
}

Result<void> ExposureControl::begin(const hal::Exposure& first) {
  const auto left = left_.exposure_limits();
  const auto right = right_.exposure_limits();
  for (const auto* limits : {&left, &right}) {
    if (*limits) continue;
    if (limits->error().code != Errc::Unsupported) return limits->error();
    state_ = State::Fixed;
    return {};
  }
  limits_ = common_limits(*left, *right);
  if (limits_.least.time > limits_.most.time || limits_.least.gain > limits_.most.gain)
    return Error{Errc::Unsupported, "the two cameras share no exposure: use two of one kind"};
  return set_both({std::clamp(first.time, limits_.least.time, longest(limits_)),
                   std::clamp(first.gain, limits_.least.gain, limits_.most.gain)});
}

Result<void> ExposureControl::step(const FaceLight& left, const FaceLight& right) {
  if (state_ == State::Locked || state_ == State::Fixed) return {};
  const hal::Exposure for_left = next_exposure(exposure_, left, limits_);
  const hal::Exposure for_right = next_exposure(exposure_, right, limits_);
  const hal::Exposure next = light_taken(for_left) <= light_taken(for_right) ? for_left : for_right;
  if (next == exposure_) {
    state_ = State::Settled;
    return {};
  }
  return set_both(next);
}

Result<void> ExposureControl::lock() {
  if (state_ == State::Metering) return Error{Errc::InvalidState, "the light is still being measured"};
  if (state_ == State::Settled) state_ = State::Locked;
  return {};
}

}  // namespace relievo::firmware
