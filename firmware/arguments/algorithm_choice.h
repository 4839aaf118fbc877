// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From words to algorithms: the file first, then every --set in its order, over what is chosen to start with.
// Errors: as read_settings_file() and AlgorithmSet::set(); InvalidInput for a word without '='.
#pragma once

#include "firmware/arguments/command_line.h"
#include "hal/base/result.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware {

Result<pipeline::AlgorithmSet> choose_algorithms(const AlgorithmArgs& args,
                                                 pipeline::AlgorithmSet start = {});
Result<pipeline::Pipeline> make_pipeline(const AlgorithmArgs& args,
                                         const pipeline::StereoCalibration& calibration);

}  // namespace relievo::firmware
