// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A measurement as compare.json, with the report of the reconstruction that was measured inside.
#pragma once

#include <string>

#include "firmware/measure/measurement.h"

namespace relievo::firmware {

std::string measurement_json(const measure::Measurement& measurement, const std::string& report_json);

}  // namespace relievo::firmware
