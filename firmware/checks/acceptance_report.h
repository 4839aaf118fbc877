// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optical self-test as report.json, and as lines for a terminal. The keys are part of the product.
#pragma once

#include <string>
#include <vector>

#include "firmware/checks/optical_check.h"

namespace relievo::firmware {

std::string acceptance_json(const AcceptanceReport& report, const OpticalCheckOptions& options,
                            const pipeline::CalibrationQuality& calibration);
std::vector<std::string> acceptance_table(const AcceptanceReport& report, const OpticalCheckOptions& options,
                                          const pipeline::CalibrationQuality& calibration);

}  // namespace relievo::firmware
