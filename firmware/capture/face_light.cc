// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

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
    return invalid("the face is not in the picture: its light cannot be measured");
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

namespace {

constexpr int kUnit = 16, kReach = 2;  // pixels between the places a second difference is taken of
// Of the contrast around: an edge blurred by a Gaussian of 1.2 pixels has so much.
constexpr float kInFocus = 0.35F;
// Mean size of normal noise is 0.8 of its deviation: so far out nothing of it is met in a picture.
constexpr float kAboveNoise = 8;
constexpr float kLeast = 10 * kUnit;  // below, nobody sees an edge
constexpr std::size_t kFewBlocks = 20;
constexpr double kPlainShare = 0.2;  // of the blocks as bright, so many are taken for plain

}  // namespace

// 1 2 1 both ways; the rim stays 0 and is looked at by nobody.
void FocusPeaking::smooth(const ImageView& picture) {
  width_ = picture.width_px, height_ = picture.height_px;
  smoothed_.assign(std::size_t(width_) * std::size_t(height_), 0);
  for (int y = 1; y + 1 < height_; ++y) {
    const std::uint8_t *above = picture.row(y - 1), *here = picture.row(y), *below = picture.row(y + 1);
    std::uint16_t* to = &smoothed_[std::size_t(y) * std::size_t(width_)];
    const auto column = [&](int x) {
      return level_of(above, x, picture.format) + 2 * level_of(here, x, picture.format) +
             level_of(below, x, picture.format);
    };
    int before = column(0), now = column(1);
    for (int x = 1; x + 1 < width_; ++x) {
      const int after = column(x + 1);
      to[x] = std::uint16_t(before + 2 * now + after);
      before = now, now = after;
    }
  }
}

int FocusPeaking::response(int x, int y) const {
  const auto at = [&](int u, int v) {
    return int(smoothed_[std::size_t(v) * std::size_t(width_) + std::size_t(u)]);
  };
  const int twice = 2 * at(x, y);
  return std::max(std::abs(twice - at(x - kReach, y) - at(x + kReach, y)),
                  std::abs(twice - at(x, y - kReach) - at(x, y + kReach)));
}

void FocusPeaking::look_at_blocks() {
  across_ = width_ / kBlock, down_ = height_ / kBlock;
  blocks_.assign(std::size_t(across_) * std::size_t(down_), Block{kUnit * 255.0F, 0, 0});
  for (int y = kReach + 1; y < std::min(height_ - kReach - 1, down_ * kBlock); ++y)
    for (int x = kReach + 1; x < std::min(width_ - kReach - 1, across_ * kBlock); ++x) {
      Block& block = blocks_[std::size_t(y / kBlock) * std::size_t(across_) + std::size_t(x / kBlock)];
      const auto here = float(smoothed_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]);
      block.least = std::min(block.least, here);
      block.most = std::max(block.most, here);
      block.response += float(response(x, y)) / (kBlock * kBlock);
    }
}

// Noise grows with brightness: what is measured at a brightness bounds that of all that is darker.
void FocusPeaking::tell_noise() {
  float brighter = 1e9F;
  for (std::size_t i = kLevels; i-- > 0;) {
    sorted_.clear();
    for (int y = 1; y + 1 < down_; ++y)
      for (int x = 1; x + 1 < across_; ++x) {
        const Block& block = blocks_[std::size_t(y) * std::size_t(across_) + std::size_t(x)];
        const float middle = (block.least + block.most) / 2 / (kUnit * 256);
        if (std::size_t(middle * kLevels) == i) sorted_.push_back(block.response);
      }
    noise_[i] = brighter;
    if (sorted_.size() < kFewBlocks) continue;
    const auto plain = sorted_.begin() + std::ptrdiff_t(kPlainShare * double(sorted_.size()));
    std::ranges::nth_element(sorted_, plain);
    noise_[i] = brighter = std::min(brighter, *plain);
  }
  for (float& noise : noise_)  // brighter than all that there is
    if (noise > 1e8F) noise = brighter < 1e8F ? brighter : 0;
}

bool FocusPeaking::in_focus(int x, int y) const {
  const auto here = float(response(x, y));
  if (here < kLeast) return false;
  const int column = std::min(x / kBlock, across_ - 1), row = std::min(y / kBlock, down_ - 1);
  float least = kUnit * 255.0F, most = 0;
  for (int v = std::max(0, row - 1); v <= std::min(down_ - 1, row + 1); ++v)
    for (int u = std::max(0, column - 1); u <= std::min(across_ - 1, column + 1); ++u) {
      const Block& block = blocks_[std::size_t(v) * std::size_t(across_) + std::size_t(u)];
      least = std::min(least, block.least);
      most = std::max(most, block.most);
    }
  const auto bright = std::size_t(std::max(0.0F, most) / (kUnit * 256) * kLevels);
  return here > kInFocus * (most - least) && here > kAboveNoise * noise_[std::min(bright, kLevels - 1)];
}

double FocusPeaking::mark(const ImageView& picture, std::uint8_t* shown_rgb, int shown_width_px,
                          int shown_height_px) {
  if (shown_width_px <= 0 || shown_height_px <= 0 || picture.width_px < 4 * kBlock ||
      picture.height_px < 4 * kBlock)
    return 0;
  smooth(picture);
  look_at_blocks();
  tell_noise();
  const int step = std::max(1, width_ / shown_width_px), rim = kReach + 1;
  std::size_t marked = 0;
  for (int y = 0; y < shown_height_px; ++y)
    for (int x = 0; x < shown_width_px; ++x) {
      bool sharp = false;
      for (int v = std::max(rim, y * step); !sharp && v < std::min(height_ - rim, (y + 1) * step); ++v)
        for (int u = std::max(rim, x * step); !sharp && u < std::min(width_ - rim, (x + 1) * step); ++u)
          sharp = in_focus(u, v);
      if (!sharp) continue;
      ++marked;
      std::ranges::copy(kColour, shown_rgb + 3 * (std::ptrdiff_t(y) * shown_width_px + x));
    }
  return double(marked) / (double(shown_width_px) * shown_height_px);
}

}  // namespace relievo::firmware
