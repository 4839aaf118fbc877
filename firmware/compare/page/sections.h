// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the comparison's page. Each gives valid HTML, or nothing where
// there is nothing to say. Inside page/ only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "firmware/compare/page/maps.h"
#include "firmware/measure/comparison.h"
#include "hal/base/result.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"

namespace relievo::firmware::compare::sections {

using pipeline::report::Drawing, pipeline::report::escaped, pipeline::report::figure,
    pipeline::report::figure_of;
using Runs = std::vector<const Run*>;  // of one pair

std::string figures(const Comparison& c, const Runs& runs);         // one row a set: what matters
std::string surfaces(const Comparison& c, const Runs& runs);        // every model, and what its mesh took
Result<std::string> maps(const Comparison& c, std::size_t pair);    // the two below, sets of one map once
Result<std::string> ground(const Comparison& c, std::size_t pair);  // colours, left view, truth
// Disparities, errors, rejected matches: a row of pictures.
Result<std::string> map_row(const Comparison& c, const Run& run, const std::string& title);
std::string histograms(const Comparison& c, std::size_t pair);
std::string shared_pixels(const Comparison& c, std::size_t pair);  // every two sets where both give one
std::string costs(const Comparison& c, std::size_t pair);          // times by step, memory
std::string rules(const Comparison& c, std::size_t pair);          // what constraints took away
Result<std::string> selectors(const Comparison& c, std::size_t pair);
std::string settings(const Comparison& c, const std::string& title);
std::string swatch(Rgb colour, const std::string& words);  // an entry of a list of colours
extern const std::string_view kStyle;                      // that all of these need

// The runs of one pair, in the order of the sets.
Runs runs_of(const Comparison& c, std::size_t pair);
const std::string& name_of(const Comparison& c, const Run& run);
std::string cell(const std::string& html);  // a number's
std::string best_cell(const std::string& html, bool best);
std::string row_head(const std::string& name);  // escapes
// The first `words` columns are words, not numbers.
std::string table(const std::vector<std::string>& columns, const std::string& rows, std::size_t words = 1);

}  // namespace relievo::firmware::compare::sections
