// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/png_writer.h"

#include <png.h>

namespace relievo::storage {

// libpng's simplified interface: the other one jumps over destructors.
Result<std::vector<std::byte>> png_bytes(const pipeline::TextureAtlas& texture) {
  if (texture.width_px <= 0 || texture.height_px <= 0)
    return Error{Errc::InvalidInput, "the texture has no pixels"};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(texture.width_px);
  image.height = static_cast<png_uint_32>(texture.height_px);
  image.format = PNG_FORMAT_RGB;
  if (texture.rgb.size() != PNG_IMAGE_SIZE(image))
    return Error{Errc::InvalidInput, "the texture's size does not fit its pixels"};

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> out(size);
  if (png_image_write_to_memory(&image, out.data(), &size, 0, texture.rgb.data(), 0, nullptr) == 0) {
    png_image_free(&image);
    return Error{Errc::OutOfMemory, "not enough memory to compress the texture"};
  }
  out.resize(size);
  return out;
}

}  // namespace relievo::storage
