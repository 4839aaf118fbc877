// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From words to algorithms: the file first, then every --set in its order, over what is chosen to start with.
// Errors: of a file NotFound, IoFailed, InvalidInput with file and line (not TOML, deeper than one table); as
// AlgorithmSet::set(); InvalidInput for a word without '='. Thread: any.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "hal/base/result.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware {

// A set of algorithms in TOML, as the words that --set takes: one table a stage or algorithm.
//   [matcher] name = "zmncc"        ->  matcher=zmncc
//   [zmncc]   window_px = 15        ->  zmncc.window_px=15
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

// What is in the files that the options name, as far as it is not there. Errors: read_whole_file()'s.
Result<void> read_texts(pipeline::AlgorithmSet& set);
// With the texts of its files.
Result<pipeline::AlgorithmSet> choose_algorithms(const AlgorithmArgs& args,
                                                 pipeline::AlgorithmSet start = {});
Result<pipeline::Pipeline> make_pipeline(const AlgorithmArgs& args,
                                         const pipeline::StereoCalibration& calibration);
// What AlgorithmSet::to_text() has said, by key.
std::map<std::string, std::string> choices_in(const std::string& text);

}  // namespace relievo::firmware
