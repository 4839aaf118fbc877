// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A texture as a PNG file: 8 bit RGB, sRGB.
// Errors: InvalidInput (no pixels), OutOfMemory. May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::storage {

Result<std::vector<std::byte>> png_bytes(const pipeline::TextureAtlas& texture);

}  // namespace relievo::storage
