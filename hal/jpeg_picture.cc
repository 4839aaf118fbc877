// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <turbojpeg.h>

#include <memory>
#include <new>

#include "hal/picture_file.h"

namespace relievo::hal {

Result<std::vector<std::byte>> encode_jpeg(const ImageView& image, int quality_percent) try {
  if (image.empty()) return invalid("there is no picture to write");
  if (image.format == PixelFormat::Grey16) return invalid("a JPEG cannot hold 16 bit; write a .png");
  const bool grey = image.format == PixelFormat::Grey8;
  const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitCompress(), tjDestroy);
  if (!handle) return Error{Errc::OutOfMemory, "no memory to encode a picture"};
  const int sampling = grey ? TJSAMP_GRAY : TJSAMP_420;
  // The largest it may become: with room of its own libjpeg-turbo need not ask for more.
  std::vector<std::byte> bytes(tjBufSize(image.width_px, image.height_px, sampling));
  auto* out = reinterpret_cast<unsigned char*>(bytes.data());
  unsigned long size = bytes.size();
  if (tjCompress2(handle.get(), image.row(0), image.width_px, image.stride_bytes, image.height_px,
                  grey ? TJPF_GRAY : TJPF_RGB, &out, &size, sampling, quality_percent,
                  TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0)
    return Error{Errc::LibraryFailed, "cannot encode this picture"};
  bytes.resize(size);
  return bytes;
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to encode a picture"};
}

}  // namespace relievo::hal
