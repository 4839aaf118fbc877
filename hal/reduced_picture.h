// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture made smaller, each pixel the mean of those it stands for; Grey8 or Rgb8. Errors: InvalidInput,
// OutOfMemory. Thread: any.
#pragma once

#include "hal/picture_file.h"

namespace relievo::hal {

Result<Picture> reduced(const ImageView& image, int width_px, int height_px);

}  // namespace relievo::hal
