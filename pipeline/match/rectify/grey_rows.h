// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Grey values 0 to 255 of a picture's rows, whatever its format: 16 bit scaled down, colour as the mean of
// its channels: the least noise for texture that all three share. Thread: any. No errors.
#pragma once

#include "hal/base/image_view.h"

namespace relievo::pipeline {

// Row y goes to `to + y * stride`.
void grey_rows(const ImageView& image, float* to, int stride, int begin, int end);

}  // namespace relievo::pipeline
