// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/fuzz_targets.h"

#include <algorithm>

#include "tests/support/temporary_folder.h"

namespace relievo::test {

std::vector<FuzzTarget> fuzz_targets() {
  std::vector<FuzzTarget> all;
  for (auto* some : {picture_targets, calibration_targets, text_targets, model_targets, store_targets})
    for (FuzzTarget& one : some()) all.push_back(std::move(one));
  return all;
}

std::filesystem::path in_file(const std::string& name, FuzzBytes input) {
  static const TemporaryFolder folder;
  const auto own = folder / ("of " + name);
  std::filesystem::create_directory(own);
  write_text(own / name, std::string(text_of(input)));
  return own / name;
}

std::string patched(std::string good, FuzzBytes input) {
  while (input.size() > 4 && !good.empty()) {
    const std::size_t at = (input[0] + 256U * input[1] + 65'536U * input[2]) % good.size();
    const std::size_t count = std::min<std::size_t>({input[3] % 32U, good.size() - at, input.size() - 4});
    if (input[3] == 0xFF) {
      good.resize(at);
      break;
    }
    for (std::size_t i = 0; i < count; ++i) good[at + i] = static_cast<char>(input[4 + i]);
    input = input.subspan(4 + count);
  }
  return good;
}

}  // namespace relievo::test
