// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every report's page is made of: one file of HTML that needs nothing beside it, no network and no
// script, and that prints on A4. Texts from outside are escaped by whoever hands them over (text.h), but for
// those of heading() and page(), which escape. Thread: any; the same input gives the same text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace relievo::pipeline::report {

// `more_style` follows the style of all pages.
std::string page(std::string_view title, std::string_view more_style, std::string_view body);

// Product, title, and a line of facts; the facts are HTML.
std::string heading(std::string_view product, std::string_view title, const std::vector<std::string>& facts);

// Two figures side by side, one under the other where there is no room.
std::string side_by_side(std::string_view one, std::string_view other);
std::string figure_of(std::string_view svg, std::string_view title, std::string_view caption);

}  // namespace relievo::pipeline::report
