// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A set of algorithms in TOML, as the words that --set takes: one table a stage or algorithm.
//   [matcher] name = "zmncc"        ->  matcher=zmncc
//   [zmncc]   window_px = 15        ->  zmncc.window_px=15
// Errors: NotFound, IoFailed, InvalidInput with file and line (not TOML, deeper than one table).
// Thread: any.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"

namespace relievo::firmware {

Result<std::vector<std::string>> read_settings_file(const std::filesystem::path& file);
Result<std::vector<std::string>> parse_settings(std::string_view text, std::string_view file_name);

// Several sets in one file: a table each, named as the set, in it the same words; in the file's order.
//   ["SSD 21"]
//   matcher = "ssd"              ->  SSD 21: matcher=ssd
//   ssd.window_px = 21           ->  SSD 21: ssd.window_px=21
struct SetWords {
  std::string name;
  std::vector<std::string> settings;
};
Result<std::vector<SetWords>> read_sets_file(const std::filesystem::path& file);
Result<std::vector<SetWords>> parse_sets(std::string_view text, std::string_view file_name);

}  // namespace relievo::firmware
