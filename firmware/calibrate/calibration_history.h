// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a calibration stands in the store's history, and how the history is told. Thread: any.
#pragma once

#include <string>

#include "pipeline/calibrate/quality/quality.h"
#include "storage/record.h"

namespace relievo::firmware {

storage::CalibrationFigures figures_of(const pipeline::CalibrationQuality& quality);

// A table: the heading, and a line for each. What nobody knows is a dash.
std::string history_heading();
std::string line_of(const storage::CalibrationInfo& calibration);

}  // namespace relievo::firmware
