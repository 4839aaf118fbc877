// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/focus_peaking.h"

#include <algorithm>
#include <cstdlib>

#include "firmware/capture/face_light.h"

namespace relievo::firmware {
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
