// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#define ZX_USE_UTF8 1
#include <ZXing/BitMatrix.h>
#include <ZXing/MultiFormatWriter.h>

#include "firmware/kiosk/code/code_picture.h"

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

}  // namespace relievo::firmware
