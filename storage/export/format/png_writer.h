// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures as PNG files (ISO/IEC 15948), by libpng: 8 bit RGB, 8 or 16 bit grey.
// Errors: InvalidInput (no pixels, or sizes that do not fit), OutOfMemory. Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::storage {

Result<std::vector<std::byte>> png_of_rgb(int width_px, int height_px, std::span<const std::uint8_t> rgb);
Result<std::vector<std::byte>> png_of_grey(int width_px, int height_px, std::span<const std::uint8_t> grey);
Result<std::vector<std::byte>> png_of_grey16(int width_px, int height_px,
                                             std::span<const std::uint16_t> grey);

inline Result<std::vector<std::byte>> png_bytes(const pipeline::TextureAtlas& texture) {
  return png_of_rgb(texture.width_px, texture.height_px, texture.rgb);
}

}  // namespace relievo::storage
