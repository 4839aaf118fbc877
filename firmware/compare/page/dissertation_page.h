// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The dissertation's tables and figures, its own figures beside ours: one page of HTML that needs nothing
// beside it. Errors: those of the picture encoder. Thread: any; the same input gives the same text.
#pragma once

#include <string>

#include "firmware/compare/page/dissertation.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

Result<std::string> dissertation_html(const Dissertation& dissertation, const std::string& product,
                                      const std::string& made_at);

}  // namespace relievo::firmware::compare
