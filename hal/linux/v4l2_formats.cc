// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/v4l2_formats.h"

#include <linux/videodev2.h>

namespace relievo::hal {
namespace {

// In the kernel since 6.3; Debian 12's header is older.
constexpr std::uint32_t kY12Packed = v4l2_fourcc('Y', '1', '2', 'P');

constexpr V4l2Format kFormats[] = {
    {V4L2_PIX_FMT_SRGGB8, {RawCoding::Bits8, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG8, {RawCoding::Bits8, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG8, {RawCoding::Bits8, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR8, {RawCoding::Bits8, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB10P, {RawCoding::Packed10, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG10P, {RawCoding::Packed10, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG10P, {RawCoding::Packed10, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR10P, {RawCoding::Packed10, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB10, {RawCoding::Bits10, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG10, {RawCoding::Bits10, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG10, {RawCoding::Bits10, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR10, {RawCoding::Bits10, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB12P, {RawCoding::Packed12, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG12P, {RawCoding::Packed12, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG12P, {RawCoding::Packed12, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR12P, {RawCoding::Packed12, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_SRGGB12, {RawCoding::Bits12, ColourFilter::Rggb}},
    {V4L2_PIX_FMT_SGRBG12, {RawCoding::Bits12, ColourFilter::Grbg}},
    {V4L2_PIX_FMT_SGBRG12, {RawCoding::Bits12, ColourFilter::Gbrg}},
    {V4L2_PIX_FMT_SBGGR12, {RawCoding::Bits12, ColourFilter::Bggr}},
    {V4L2_PIX_FMT_RGB24, {RawCoding::Rgb8}},
    {V4L2_PIX_FMT_YUYV, {RawCoding::Yuyv}},
    {V4L2_PIX_FMT_NV12, {RawCoding::Nv12}},
    {V4L2_PIX_FMT_Y12, {RawCoding::Bits12}},
    {kY12Packed, {RawCoding::Packed12}},
    {V4L2_PIX_FMT_Y10, {RawCoding::Bits10}},
    {V4L2_PIX_FMT_Y10P, {RawCoding::Packed10}},
    {V4L2_PIX_FMT_Y16, {RawCoding::Bits16}},
    {V4L2_PIX_FMT_GREY, {RawCoding::Bits8}},
    {V4L2_PIX_FMT_MJPEG, {RawCoding::Mjpeg}},
    {V4L2_PIX_FMT_JPEG, {RawCoding::Mjpeg}},
};

}  // namespace

std::span<const V4l2Format> v4l2_formats() { return kFormats; }

std::optional<RawFormat> raw_format_of(std::uint32_t fourcc) {
  for (const V4l2Format& format : kFormats)
    if (format.fourcc == fourcc) return format.raw;
  return std::nullopt;
}

}  // namespace relievo::hal
