// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two drawings of a table of comparisons, as SVG that stands in a page. Thread: any.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/bench/recognition/scores.h"

namespace relievo::bench {

std::string_view score_figures_style();  // CSS, after the page's own
std::string distribution_figure(std::span<const Score> scores);
std::string rates_figure(std::span<const Score> scores);

}  // namespace relievo::bench
