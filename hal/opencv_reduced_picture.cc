// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/picture_file.h"

#include <new>
#include <opencv2/imgproc.hpp>

namespace relievo::hal {

Result<Picture> reduced(const ImageView& image, int width_px, int height_px) try {
  if (image.empty()) return invalid("there is no picture to make smaller");
  const bool colour = image.format == PixelFormat::Rgb8;
  const int type = colour ? CV_8UC3 : image.format == PixelFormat::Grey16 ? CV_16UC1 : CV_8UC1;
  // OpenCV has no const Mat over foreign bytes; this one is only read.
  cv::Mat whole(image.height_px, image.width_px, type,
                const_cast<std::byte*>(image.bytes),  // NOLINT
                std::size_t(image.stride_bytes));
  if (type == CV_16UC1) whole.convertTo(whole, CV_8U, 1.0 / 257.0);
  Picture picture{{}, width_px, height_px, colour ? PixelFormat::Rgb8 : PixelFormat::Grey8};
  picture.bytes.resize(std::size_t(width_px) * std::size_t(height_px * bytes_per_pixel(picture.format)));
  cv::Mat small(height_px, width_px, colour ? CV_8UC3 : CV_8UC1, picture.bytes.data());
  cv::resize(whole, small, small.size(), 0, 0, cv::INTER_AREA);
  return picture;
} catch (const cv::Exception& refused) {
  if (refused.code != cv::Error::StsNoMem) return invalid("this picture cannot be made so small");
  return Error{Errc::OutOfMemory, "no memory to make a picture smaller"};
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to make a picture smaller"};
}

}  // namespace relievo::hal
