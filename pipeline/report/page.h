// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every report's page is made of: one file of HTML that needs nothing beside it, no network and no
// script, and that prints on A4. Texts from outside are escaped by whoever hands them over, but for
// those of heading() and page(), which escape. Thread: any; the same input gives the same text.
#pragma once

#include <cstddef>
#include <span>
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

// Words and numbers for a page, whatever language the machine is set to.

// To stand in HTML as text or as a quoted attribute: its five characters as entities; what is no UTF-8, and
// what controls a terminal, as U+FFFD.
std::string escaped(std::string_view text);

// A file's name as a relative link: all but letters, digits and . _ ~ - as %XX.
std::string linked(std::string_view file_name);

std::string base64(std::span<const std::byte> bytes);

// For people: so many decimals, a true minus sign; a dash where there is no number.
std::string figure(double value, int decimals);
// For attributes: at most so many decimals, as few as needed.
std::string number(double value, int decimals = 1);
// As many decimals as two digits of `sigma` need, at most 7.
int decimals_for(double sigma);

// Enough decimals for a small figure not to read as nought.
int decimals_of(double value);

// "pair", "pairs": with the count before it.
std::string counted(int count, std::string_view one, std::string_view many);

// First letter large, a full stop at the end, a true plus-minus sign: a reason as a sentence.
std::string sentence(std::string_view reason);

}  // namespace relievo::pipeline::report
