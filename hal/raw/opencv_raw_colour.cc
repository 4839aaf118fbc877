// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <new>

#include "hal/base/assert.h"
#include "hal/raw/develop.h"

namespace relievo::hal {
namespace {

// By ColourFilter, from the first one on. OpenCV names a filter by the second and third pixel of the second
// row.
constexpr int kEdgeAware[] = {cv::COLOR_BayerBG2RGB_EA, cv::COLOR_BayerGB2RGB_EA, cv::COLOR_BayerGR2RGB_EA,
                              cv::COLOR_BayerRG2RGB_EA};

Result<void> convert(const RawImage& raw, int type, int rows, int code, std::byte* rgb) try {
  // OpenCV has no const Mat over foreign bytes; this one is only read.
  const cv::Mat from(rows, raw.width_px, type,
                     const_cast<std::byte*>(raw.bytes),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
                     std::size_t(raw.stride_bytes));
  cv::Mat to(raw.height_px, raw.width_px, CV_8UC3, rgb);
  const auto* const place = to.data;
  cv::cvtColor(from, to, code);
  RELIEVO_ASSERT(to.data == place);  // of the right size and type, so OpenCV has not taken other memory
  return {};
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to develop a camera's picture"};
} catch (const cv::Exception&) {
  return Error{Errc::LibraryFailed, "a camera's picture could not be developed"};
}

}  // namespace

Result<void> demosaic(const RawImage& raw, std::byte* rgb) {
  RELIEVO_ASSERT(raw.format.filter != ColourFilter::None);  // without a filter there is no mosaic
  return convert(raw, CV_8UC1, raw.height_px, kEdgeAware[int(raw.format.filter) - 1], rgb);
}

Result<void> yuv_to_rgb(const RawImage& raw, std::byte* rgb) {
  if (raw.format.coding == RawCoding::Yuyv)
    return convert(raw, CV_8UC2, raw.height_px, cv::COLOR_YUV2RGB_YUYV, rgb);
  return convert(raw, CV_8UC1, raw.height_px / 2 * 3, cv::COLOR_YUV2RGB_NV12, rgb);
}

}  // namespace relievo::hal
