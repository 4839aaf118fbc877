// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StagePictures: small square pictures of the face for the screen: the photograph, then one for each stage
// that is done. Fixed memory, part of the session: wiped with it. Thread: who takes or makes it draws its
// picture before it reports; main reads those reported.
#pragma once

#include <string.h>

#include <array>
#include <cstdint>
#include <vector>

#include "firmware/base/budget.h"
#include "hal/base/image_view.h"

namespace relievo::firmware {

inline constexpr std::size_t kStagePictures =
    5;  // Capture, Match, Reconstruct, Mesh, Texture; Assemble has none

class StagePictures {
 public:
  static constexpr int kSide = budget::kStagePictureSidePx;

  StagePictures() {
    for (One& one : pictures_) one.rgb.resize(std::size_t{3} * kSide * kSide);
  }
  std::uint8_t* begin(std::size_t stage) { return pictures_[stage].rgb.data(); }
  void done(std::size_t stage) { pictures_[stage].number = ++count_; }
  std::uint32_t number(std::size_t stage) const { return pictures_[stage].number; }  // 0: not drawn
  ImageView view(std::size_t stage) const {
    return {reinterpret_cast<const std::byte*>(pictures_[stage].rgb.data()), kSide, kSide, 3 * kSide,
            PixelFormat::Rgb8};
  }
  void wipe() {
    for (One& one : pictures_) {
      if (one.number != 0) explicit_bzero(one.rgb.data(), one.rgb.size());
      one.number = 0;
    }
  }

 private:
  struct One {
    std::vector<std::uint8_t> rgb;
    std::uint32_t number = 0;
  };
  std::array<One, kStagePictures> pictures_;
  std::uint32_t count_ = 0;
};

}  // namespace relievo::firmware
