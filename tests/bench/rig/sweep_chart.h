// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweep as one picture: SVG, several panels, axes with units.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/rig/rig_plan.h"

namespace relievo::bench {

std::string draw_sweep(const std::vector<Row>& rows);

}  // namespace relievo::bench
