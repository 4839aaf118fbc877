// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A comparison as compare.json. The keys are part of the product: scripts read them.
#pragma once

#include <string>

#include "firmware/compare/page/dissertation.h"
#include "firmware/measure/comparison.h"

namespace relievo::firmware::compare {

std::string comparison_json(const Comparison& comparison, const std::string& made_at);
std::string dissertation_json(const Dissertation& dissertation, const std::string& made_at);

}  // namespace relievo::firmware::compare
