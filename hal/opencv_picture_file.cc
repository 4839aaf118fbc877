// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cctype>
#include <cstring>
#include <new>
#include <string>

#include "hal/picture_file.h"
#include "hal/picture_header.h"
#include "hal/whole_file.h"

namespace relievo::hal {
namespace {

// No picture within the limits is larger than this, even stored without any compression.
constexpr std::size_t kMaxEncodedBytes = static_cast<std::size_t>(kMaxPictureAreaPx) * 8 + (1U << 20);

Result<void> check_limits(const PictureHeader& header) {
  if (header.width_px <= 0 || header.height_px <= 0)
    return Error{Errc::InvalidInput, "this picture has no size"};
  if (header.width_px > kMaxPictureSidePx || header.height_px > kMaxPictureSidePx ||
      header.width_px * header.height_px > kMaxPictureAreaPx)
    return Error{Errc::InvalidInput,
                 "this picture is larger than the limit of 8192 px a side and 40 megapixels"};
  return {};
}

// Grey stays what it is; colour becomes 8 bit: no stage looks at deeper colour.
Result<Picture> to_picture(cv::Mat image) {
  if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
  if (image.channels() == 3 && image.depth() == CV_16U) image.convertTo(image, CV_8U, 1.0 / 257.0);
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  Picture picture;
  if (image.type() == CV_8UC1) picture.format = PixelFormat::Grey8;
  else if (image.type() == CV_8UC3) picture.format = PixelFormat::Rgb8;
  else if (image.type() == CV_16UC1) picture.format = PixelFormat::Grey16;
  else return Error{Errc::InvalidInput, "this picture has a pixel format that is not supported"};
  picture.width_px = image.cols;
  picture.height_px = image.rows;
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  picture.bytes.resize(row_bytes * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y)
    std::memcpy(picture.bytes.data() + row_bytes * static_cast<std::size_t>(y), image.ptr(y), row_bytes);
  return picture;
}

Result<cv::Mat> to_mat(const ImageView& image) {
  if (image.empty()) return Error{Errc::InvalidInput, "there is no picture to write"};
  RELIEVO_TRY(check_limits({image.width_px, image.height_px}));
  const int type = image.format == PixelFormat::Rgb8     ? CV_8UC3
                   : image.format == PixelFormat::Grey16 ? CV_16UC1
                                                         : CV_8UC1;
  // OpenCV has no const Mat over foreign bytes; this one is only read.
  const cv::Mat borrowed(image.height_px, image.width_px, type,
                         const_cast<std::byte*>(image.bytes),  // NOLINT
                         static_cast<std::size_t>(image.stride_bytes));
  if (image.format != PixelFormat::Rgb8) return borrowed;
  cv::Mat turned;  // memory of its own: the lender's must not change
  cv::cvtColor(borrowed, turned, cv::COLOR_RGB2BGR);
  return turned;
}

Result<std::vector<std::byte>> encode(const ImageView& image, const char* extension,
                                      const std::vector<int>& options) try {
  RELIEVO_TRY_ASSIGN(const cv::Mat mat, to_mat(image));
  std::vector<unsigned char> encoded;
  if (!cv::imencode(extension, mat, encoded, options))
    return Error{Errc::LibraryFailed, "cannot encode this picture"};
  std::vector<std::byte> bytes(encoded.size());
  std::memcpy(bytes.data(), encoded.data(), encoded.size());
  return bytes;
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to encode a picture"};
} catch (const cv::Exception&) {
  return Error{Errc::LibraryFailed, "cannot encode this picture"};
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().native();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

Result<Picture> decode_picture(const std::byte* bytes, std::size_t size) try {
  RELIEVO_TRY_ASSIGN(const PictureHeader header, read_picture_header({bytes, size}));
  RELIEVO_TRY(check_limits(header));
  const cv::Mat encoded(1, static_cast<int>(size), CV_8UC1,
                        const_cast<std::byte*>(bytes));  // NOLINT: read only
  // The orientation tag is ignored: a calibration knows the sensor's pixels, not how a viewer turns them.
  constexpr int kFlags = cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION;
  const cv::Mat image = cv::imdecode(encoded, kFlags);
  if (image.empty()) return Error{Errc::InvalidInput, "this picture is damaged and cannot be decoded"};
  return to_picture(image);
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to decode this picture"};
} catch (const cv::Exception& failure) {
  if (failure.code == cv::Error::StsNoMem)
    return Error{Errc::OutOfMemory, "no memory to decode this picture"};
  return Error{Errc::InvalidInput, "this picture is damaged and cannot be decoded"};
}

Result<Picture> read_picture(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, read_whole_file(file, kMaxEncodedBytes));
  Result<Picture> picture = decode_picture(bytes.data(), bytes.size());
  if (!picture) return picture.error().at(file.native());
  return picture;
}

Result<std::vector<std::byte>> encode_png(const ImageView& image) {
  // Level 3 with filters on costs a quarter of the best level's time for a few per cent of size.
  return encode(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 3});
}

Result<std::vector<std::byte>> encode_jpeg(const ImageView& image, int quality_percent) {
  if (image.format == PixelFormat::Grey16) return Error{Errc::InvalidInput, "a JPEG cannot hold 16 bit"};
  return encode(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality_percent});
}

Result<void> write_picture(const std::filesystem::path& file, const ImageView& image) {
  const std::string extension = lower_extension(file);
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  if (!jpeg && extension != ".png")
    return Error{Errc::InvalidInput, "pictures are written as .png or .jpg; choose one of these names"}.at(
        file.native());
  if (jpeg && image.format == PixelFormat::Grey16)
    return Error{Errc::InvalidInput, "a JPEG cannot hold 16 bit; write a .png"}.at(file.native());
  Result<std::vector<std::byte>> bytes = jpeg ? encode_jpeg(image, 95) : encode_png(image);
  if (!bytes) return bytes.error().at(file.native());
  return write_whole_file(file, *bytes);
}

}  // namespace relievo::hal
