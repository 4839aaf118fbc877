// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#define ZX_USE_UTF8 1
#include <ZXing/ReadBarcode.h>

#include "firmware/kiosk/code/code_reader.h"

namespace relievo::firmware {
namespace {

class ZxingCodeReader final : public CodeReader {
 public:
  std::optional<std::string> read(const ImageView& picture) override try {
    if (picture.format == PixelFormat::Grey16) return std::nullopt;
    const auto format =
        picture.format == PixelFormat::Rgb8 ? ZXing::ImageFormat::RGB : ZXing::ImageFormat::Lum;
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
};

}  // namespace

std::unique_ptr<CodeReader> CodeReader::make() { return std::make_unique<ZxingCodeReader>(); }

}  // namespace relievo::firmware
