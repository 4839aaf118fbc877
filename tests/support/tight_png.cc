// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/tight_png.h"

#include <algorithm>

#include "hal/base/whole_file.h"

namespace relievo::test {

bool write_tight_png(const hal::Picture& rgb, int step, const std::filesystem::path& file) {
  hal::Picture coarse = rgb;
  for (std::byte& value : coarse.bytes)
    value = std::byte(std::min(255, (std::to_integer<int>(value) + step / 2) / step * step));
  const auto png = hal::encode_png(coarse.view(), {.level = 9});
  return png && write_whole_file(file, *png);
}

}  // namespace relievo::test
