// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/live_feed.h"

#include <string.h>

#include <algorithm>
#include <utility>

namespace relievo::firmware {
namespace {

constexpr std::size_t kRoom = std::size_t{budget::kLiveSidePx} * budget::kLiveSidePx * 3;

// Means over step x step pixels.
void shrink(const ImageView& from, int step, int width, int height, std::uint8_t* to) {
  const int bytes = bytes_per_pixel(from.format);
  const unsigned count = unsigned(step) * unsigned(step);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, to += 3) {
      unsigned sum[3] = {0, 0, 0};
      for (int v = 0; v < step; ++v) {
        const std::uint8_t* at = from.row(y * step + v) + std::ptrdiff_t(x) * step * bytes;
        for (int u = 0; u < step; ++u, at += bytes) {
          // Of 16 bits the upper ones: the second byte.
          for (int c = 0; c < 3; ++c)
            sum[c] +=
                from.format == PixelFormat::Rgb8 ? at[c] : at[from.format == PixelFormat::Grey16 ? 1 : 0];
        }
      }
      for (int c = 0; c < 3; ++c) to[c] = std::uint8_t(sum[c] / count);
    }
  }
}

}  // namespace

LiveFeed::LiveFeed(int side_px) : side_px_(side_px) {
  for (Slot& slot : slots_) slot.rgb.resize(kRoom);
}

ImageView LiveFeed::fill(const ImageView& picture) {
  Slot& slot = slots_[filling_];
  const int longer = std::max(picture.width_px, picture.height_px);
  const int step = (longer + side_px_ - 1) / side_px_;
  const int width = picture.width_px / step, height = picture.height_px / step;
  const auto bytes = std::size_t(width) * std::size_t(height) * 3;
  if (slot.rgb.size() < bytes) slot.rgb.resize(bytes);
  shrink(picture, step, width, height, slot.rgb.data());
  slot.live.picture = {reinterpret_cast<const std::byte*>(slot.rgb.data()), width, height, 3 * width,
                       PixelFormat::Rgb8};
  return slot.live.picture;
}

void LiveFeed::publish(ui::LiveView guidance) {
  ui::LiveView& live = slots_[filling_].live;
  guidance.picture = live.picture;
  guidance.number = ++count_;
  live = guidance;
  const std::lock_guard lock(mutex_);
  std::swap(filling_, newest_);
  fresh_ = true;
}

ui::LiveView LiveFeed::newest() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(fresh_, false)) std::swap(shown_, newest_);
  return slots_[shown_].live;
}

void LiveFeed::wipe() {
  const std::lock_guard lock(mutex_);
  for (Slot& slot : slots_) {
    if (slot.live.picture.empty()) continue;
    explicit_bzero(slot.rgb.data(), slot.rgb.size());
    slot.live = {};
  }
  fresh_ = false;
}

}  // namespace relievo::firmware
