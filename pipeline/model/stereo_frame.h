// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StereoFrame: two pictures of one instant, as the cameras gave them (borrowed).
#pragma once

#include <cstdint>

#include "hal/base/image_view.h"

namespace relievo::pipeline {

struct StereoFrame {
  ImageView left;
  ImageView right;
  std::uint32_t sequence = 0;
  std::int64_t skew_ns = 0;  // exposure of right minus left
};

}  // namespace relievo::pipeline
