// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <turbojpeg.h>

#include <memory>
#include <string_view>

#include "hal/raw/develop.h"

namespace relievo::hal {

Result<PixelFormat> decode_jpeg(const RawImage& raw, std::byte* pixels) {
  const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitDecompress(), tjDestroy);
  if (!handle) return Error{Errc::OutOfMemory, "no memory to decode a picture"};
  const auto* stream = reinterpret_cast<const unsigned char*>(raw.bytes);
  int width = 0;
  int height = 0;
  int sampling = 0;
  int colours = 0;
  if (tjDecompressHeader3(handle.get(), stream, raw.size_bytes, &width, &height, &sampling, &colours) != 0)
    return invalid("this JPEG picture has a damaged header");
  if (width != raw.width_px || height != raw.height_px)
    return invalid("this JPEG picture has another size than it should");
  if (colours != TJCS_YCbCr && colours != TJCS_GRAY && colours != TJCS_RGB)
    return invalid("this JPEG picture is in a colour space that is not supported");
  const bool grey = colours == TJCS_GRAY;
  // Half a picture would be believed by a matcher: the first warning ends the decoding. But many webcams
  // leave stray bytes between the last row and the end marker: all of the picture is there.
  if (tjDecompress2(handle.get(), stream, raw.size_bytes, reinterpret_cast<unsigned char*>(pixels), width, 0,
                    height, grey ? TJPF_GRAY : TJPF_RGB,
                    TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT) != 0 &&
      !std::string_view(tjGetErrorStr2(handle.get())).ends_with("extraneous bytes before marker 0xd9"))
    return invalid("this JPEG picture is damaged");
  return grey ? PixelFormat::Grey8 : PixelFormat::Rgb8;
}

}  // namespace relievo::hal
