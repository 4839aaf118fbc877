// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/tight_png.h"

namespace relievo::test {

bool write_tight_png(const hal::Picture& rgb, int step, const std::filesystem::path& file) {
  cv::Mat bgr(rgb.height_px, rgb.width_px, CV_8UC3);
  for (std::size_t i = 0; i < rgb.bytes.size(); ++i)
    bgr.data[i / 3 * 3 + 2 - i % 3] = static_cast<std::uint8_t>(
        std::min(255, (std::to_integer<int>(rgb.bytes[i]) + step / 2) / step * step));
  return cv::imwrite(file.string(), bgr, {cv::IMWRITE_PNG_COMPRESSION, 9});
}

}  // namespace relievo::test
