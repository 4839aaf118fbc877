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

// What is in the files that the options name, as far as it is not there. Errors: read_whole_file()'s.
Result<void> read_texts(pipeline::AlgorithmSet& set);
// With the texts of its files.
Result<pipeline::AlgorithmSet> choose_algorithms(const AlgorithmArgs& args,
                                                 pipeline::AlgorithmSet start = {});
Result<pipeline::Pipeline> make_pipeline(const AlgorithmArgs& args,
                                         const pipeline::StereoCalibration& calibration);

}  // namespace relievo::firmware
