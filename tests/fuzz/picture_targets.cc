// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures in files and in cameras' buffers.
#include "firmware/measure/comparison.h"
#include "hal/base/assert.h"
#include "hal/picture_file.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/hal/raw/raw_fuzz.h"

namespace relievo::test {
namespace {

bool decode(FuzzBytes input) {
  const auto picture = hal::decode_picture(bytes_of(input).data(), input.size());
  if (!picture) return false;
  RELIEVO_ASSERT(picture->width_px > 0 && picture->width_px <= hal::kMaxPictureSidePx);
  RELIEVO_ASSERT(picture->height_px > 0 && picture->height_px <= hal::kMaxPictureSidePx);
  const ImageView view = picture->view();
  RELIEVO_ASSERT(picture->bytes.size() ==
                 static_cast<std::size_t>(view.stride_bytes) * static_cast<std::size_t>(view.height_px));
  return true;
}

bool disparities(FuzzBytes input) {
  return firmware::compare::read_pfm(in_file("disparity.pfm", input)).has_value();
}

std::vector<std::string> pictures() {
  std::vector<std::string> all;
  for (const PixelFormat format : {PixelFormat::Grey8, PixelFormat::Rgb8, PixelFormat::Grey16}) {
    hal::Picture picture{{}, 9, 7, format};
    for (int i = 0; i < 9 * 7 * bytes_per_pixel(format); ++i)
      picture.bytes.push_back(std::byte(i * 37 % 251));
    if (const auto png = hal::encode_png(picture.view())) all.push_back(text_of(*png));
    if (format == PixelFormat::Grey16) continue;
    if (const auto jpeg = hal::encode_jpeg(picture.view(), 80)) all.push_back(text_of(*jpeg));
  }
  return all;
}

std::string raw_picture() {
  std::string whole{static_cast<char>(hal::RawCoding::Mjpeg), 0, 8, 6, 8, 0, 0, 0};
  return whole + pictures()[3];
}

}  // namespace

std::vector<FuzzTarget> picture_targets() {
  return {{"raw", hal::fuzz_raw, {raw_picture()}},
          {"picture", decode, pictures()},
          {"pfm", disparities, {std::string("Pf\n2 2\n-1.0\n") + std::string(16, '\1')}}};
}

}  // namespace relievo::test
