// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/aruco.hpp>

#include "hal/sim/board_scene.h"

namespace relievo::hal::sim {

std::vector<std::uint64_t> marker_modules(int bits, int count) {
  const int names[] = {cv::aruco::DICT_4X4_1000, cv::aruco::DICT_5X5_1000, cv::aruco::DICT_6X6_1000,
                       cv::aruco::DICT_7X7_1000};
  const cv::Ptr<cv::aruco::Dictionary> dictionary = cv::aruco::getPredefinedDictionary(names[bits - 4]);
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

}  // namespace relievo::hal::sim
