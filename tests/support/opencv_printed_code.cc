// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/core.hpp>
#include <opencv2/objdetect.hpp>

#include "tests/support/printed_code.h"

namespace relievo::test {

hal::Picture printed_code(const std::string& text) {
  cv::Mat code;
  cv::QRCodeEncoder::create()->encode(text, code);
  constexpr int kModule = 10, kMargin = 4;
  hal::Picture sheet;
  sheet.width_px = sheet.height_px = (code.cols + 2 * kMargin) * kModule;
  sheet.format = PixelFormat::Grey8;
  sheet.bytes.assign(static_cast<std::size_t>(sheet.width_px) * static_cast<std::size_t>(sheet.height_px),
                     std::byte{255});
  for (int y = 0; y < code.rows * kModule; ++y)
    for (int x = 0; x < code.cols * kModule; ++x)
      sheet.bytes[static_cast<std::size_t>(y + kMargin * kModule) * static_cast<std::size_t>(sheet.width_px) +
                  static_cast<std::size_t>(x + kMargin * kModule)] =
          std::byte{code.at<std::uint8_t>(y / kModule, x / kModule)};
  return sheet;
}

}  // namespace relievo::test
