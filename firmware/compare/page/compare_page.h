// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A comparison for people: one page of HTML that needs nothing beside it (see pipeline/report/page.h); and
// for programs: compare.json, whose keys are part of the product. Errors: those of the picture encoder.
// Thread: any; the same input gives the same text.
#pragma once

#include <string>

#include "firmware/compare/page/dissertation.h"
#include "firmware/measure/comparison.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

Result<std::string> comparison_html(const Comparison& comparison, const std::string& product,
                                    const std::string& made_at);
std::string comparison_json(const Comparison& comparison, const std::string& made_at);
std::string dissertation_json(const Dissertation& dissertation, const std::string& made_at);

}  // namespace relievo::firmware::compare
