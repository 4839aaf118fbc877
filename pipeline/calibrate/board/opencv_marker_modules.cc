// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include <opencv2/aruco.hpp>

#include "pipeline/calibrate/board/lattice.h"

namespace relievo::pipeline {

std::vector<std::uint64_t> marker_modules(int bits, int count) {
  constexpr std::array<int, 4> kNames{cv::aruco::DICT_4X4_1000, cv::aruco::DICT_5X5_1000,
                                      cv::aruco::DICT_6X6_1000, cv::aruco::DICT_7X7_1000};
  const auto dictionary = cv::aruco::getPredefinedDictionary(kNames[std::size_t(bits - 4)]);
  std::vector<std::uint64_t> markers;
  for (int id = 0; id < count; ++id) {
    const cv::Mat white =
        cv::aruco::Dictionary::getBitsFromByteList(dictionary->bytesList.rowRange(id, id + 1), bits);
    std::uint64_t modules = 0;
    for (int i = 0; i < bits * bits; ++i)
      if (white.at<unsigned char>(i / bits, i % bits) != 0) modules |= std::uint64_t{1} << i;
    markers.push_back(modules);
  }
  return markers;
}

}  // namespace relievo::pipeline
