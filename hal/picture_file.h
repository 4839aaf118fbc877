// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture in a file: PNG or JPEG, 8 or 16 bit, grey or colour. Read whole into memory that the
// Picture owns; written through a temporary name and renamed, so that nobody meets half a file.
// Errors: NotFound, InvalidInput (not a picture, empty, larger than the limit), IoFailed, MediaFull.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace relievo::hal {

// Longest side and area that are read: twice today's largest industrial sensor class we support.
inline constexpr int kMaxPictureSidePx = 8192;
inline constexpr long kMaxPictureAreaPx = 40'000'000;

struct Picture {
  std::vector<std::byte> bytes;
  int width_px = 0;
  int height_px = 0;
  PixelFormat format = PixelFormat::Rgb8;

  ImageView view() const {
    return {bytes.data(), width_px, height_px, width_px * bytes_per_pixel(format), format};
  }
};

Result<Picture> read_picture(const std::filesystem::path& file);  // Grey8, Rgb8 or Grey16
Result<void> write_picture(const std::filesystem::path& file, const ImageView& image);  // by extension
// A photograph of a face: level 2 after one filter takes a fifteenth of the default's time and a tenth more
// room (libpng tries all its filters, zlib looks long for what noise does not repeat). Above it, up to 9,
// libpng looks for the filters.
inline constexpr int kQuickPng = 2;
struct PngForm {
  int level = kQuickPng;
  // Says that its colours are sRGB. Not of what a camera sent: readers that turn colour into grey weigh it
  // otherwise then.
  bool is_srgb = false;
};
Result<std::vector<std::byte>> encode_png(const ImageView& image, const PngForm& form = {});
Result<std::vector<std::byte>> encode_jpeg(const ImageView& image, int quality_percent);  // Grey8 or Rgb8
Result<Picture> decode_picture(const std::byte* bytes, std::size_t size);
// bytes: a PNG that is there to its end. Grey stays what it is; colour becomes 8 bit, as no stage looks at
// deeper colour; transparency is dropped. Errors: InvalidInput, OutOfMemory. Thread: any.
Result<Picture> decode_png(std::span<const std::byte> bytes);

// A picture made smaller, each pixel the mean of those it stands for; Grey8 or Rgb8. Errors: InvalidInput,
// OutOfMemory. Thread: any.
Result<Picture> reduced(const ImageView& image, int width_px, int height_px);

std::string lower_extension(const std::filesystem::path& file);  // ".png" of A.PNG

}  // namespace relievo::hal
