// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#define ZX_USE_UTF8 1
#include <ZXing/BitMatrix.h>
#include <ZXing/MultiFormatWriter.h>
#include <ZXing/ReadBarcode.h>

#include "firmware/kiosk/code/qr_code.h"

namespace relievo::firmware {

hal::Picture code_picture(std::string_view text) try {
  constexpr int kMarginModules = 4;
  const ZXing::BitMatrix modules = ZXing::MultiFormatWriter(ZXing::BarcodeFormat::QRCode)
                                       .setMargin(kMarginModules)
                                       .encode(std::string(text), 0, 0);
  hal::Picture picture;
  picture.format = PixelFormat::Grey8;
  picture.width_px = modules.width() * kCodeModulePx;
  picture.height_px = modules.height() * kCodeModulePx;
  picture.bytes.reserve(std::size_t(picture.width_px) * std::size_t(picture.height_px));
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      picture.bytes.push_back(modules.get(x / kCodeModulePx, y / kCodeModulePx) ? std::byte{0}
                                                                                : std::byte{255});
  return picture;
} catch (const std::exception&) {
  return {};
}

std::optional<std::string> read_code(const ImageView& picture) try {
  if (picture.format == PixelFormat::Grey16) return std::nullopt;
  const auto format = picture.format == PixelFormat::Rgb8 ? ZXing::ImageFormat::RGB : ZXing::ImageFormat::Lum;
  const ZXing::ImageView view(reinterpret_cast<const std::uint8_t*>(picture.bytes), picture.width_px,
                              picture.height_px, format, picture.stride_bytes);
  ZXing::DecodeHints hints;
  hints.setFormats(ZXing::BarcodeFormat::QRCode).setTryHarder(true).setTryRotate(true);
  const ZXing::Result found = ZXing::ReadBarcode(view, hints);
  std::string text = found.isValid() ? found.text() : std::string();
  return text.empty() ? std::nullopt : std::optional(std::move(text));
} catch (const std::exception&) {  // a code that promises more than it holds
  return std::nullopt;
}

}  // namespace relievo::firmware
