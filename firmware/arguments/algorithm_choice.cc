// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/algorithm_choice.h"

#include <string>
#include <utility>

#include "firmware/arguments/settings_file.h"
#include "hal/base/whole_file.h"

namespace relievo::firmware {
namespace {

Result<void> apply(pipeline::AlgorithmSet& set, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      return Error{Errc::InvalidInput, "is no setting: write KEY=VALUE, as in matcher=refined"}.at(setting);
    }
    RELIEVO_TRY(set.set(setting.substr(0, equals), setting.substr(equals + 1)));
  }
  return {};
}

// Larger is no list of a picture's points, not of a match at every pixel of 20 megapixels.
constexpr std::size_t kMostTextBytes = std::size_t{512} << 20;

}  // namespace

Result<void> read_texts(pipeline::AlgorithmSet& set) {
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms()) {
    if (!option.file || set.get(option.key).empty() || set.texts().contains(option.key)) continue;
    RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(set.get(option.key), kMostTextBytes));
    set.keep_text(option.key, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  return {};
}

Result<pipeline::AlgorithmSet> choose_algorithms(const AlgorithmArgs& args, pipeline::AlgorithmSet start) {
  pipeline::AlgorithmSet set = std::move(start);
  if (!args.file.empty()) {
    RELIEVO_TRY_ASSIGN(const auto settings, read_settings_file(args.file));
    RELIEVO_TRY(apply(set, settings));
  }
  RELIEVO_TRY(apply(set, args.settings));
  RELIEVO_TRY(read_texts(set));
  return set;
}

Result<pipeline::Pipeline> make_pipeline(const AlgorithmArgs& args,
                                         const pipeline::StereoCalibration& calibration) {
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet set, choose_algorithms(args));
  return pipeline::Pipeline::make(set, calibration, {},
                                  args.whole_view ? pipeline::Region::All : pipeline::Region::Face);
}

}  // namespace relievo::firmware
