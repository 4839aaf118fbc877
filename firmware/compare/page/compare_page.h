// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A comparison for people: one page of HTML that needs nothing beside it (see pipeline/report/page.h).
// Errors: those of the picture encoder. Thread: any; the same input gives the same text.
#pragma once

#include <string>

#include "firmware/measure/comparison.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

Result<std::string> comparison_html(const Comparison& comparison, const std::string& product,
                                    const std::string& made_at);

}  // namespace relievo::firmware::compare
