// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/algorithm_choice.h"

#include <utility>

#include "firmware/arguments/settings_file.h"

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

}  // namespace

Result<pipeline::AlgorithmSet> choose_algorithms(const AlgorithmArgs& args, pipeline::AlgorithmSet start) {
  pipeline::AlgorithmSet set = std::move(start);
  if (!args.file.empty()) {
    RELIEVO_TRY_ASSIGN(const auto settings, read_settings_file(args.file));
    RELIEVO_TRY(apply(set, settings));
  }
  RELIEVO_TRY(apply(set, args.settings));
  return set;
}

Result<pipeline::Pipeline> make_pipeline(const AlgorithmArgs& args,
                                         const pipeline::StereoCalibration& calibration) {
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet set, choose_algorithms(args));
  return pipeline::Pipeline::make(set, calibration, {},
                                  args.whole_view ? pipeline::Region::All : pipeline::Region::Face);
}

}  // namespace relievo::firmware
