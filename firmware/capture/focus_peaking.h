// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FocusPeaking: which places of a camera's picture are in focus, for a hand at the lens. An edge is in focus
// where its second difference is a large share of the contrast around it, however high that is, and far above
// the noise of places as bright. Memory stays from picture to picture. Thread: one at a time. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"

namespace relievo::firmware {

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
