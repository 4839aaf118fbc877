// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/page/compare_page.h"

#include <algorithm>
#include <sstream>

#include "firmware/compare/page/sections.h"

namespace relievo::firmware::compare {
namespace sections {

const std::string_view kStyle = R"css(
.sets { font-size: 14px; margin-top: 6px; }
.sets thead th { padding-right: 10px; } .sets thead th.value { white-space: normal; } .sets thead small { font-size: 12px; }
.sets td, .sets tbody th { padding: 6px 10px 6px 0; } .sets tbody th { font-weight: 600; } .sets td small { font-size: 12px; }
.sets th:last-child, .sets td:last-child { padding-right: 0; } .sets td.value { white-space: normal; }
.reading p + p { margin-top: 6px; }
.sets .best { font-weight: 700; color: var(--good); }
.sets .failed, .failed { color: var(--bad); }
.sets .bars { width: 22%; min-width: 80px; } .sets .bars svg { display: block; width: 100%; height: 16px; margin-top: 4px; }
.topic { font-size: 16px; margin: 34px 0 8px; padding-top: 14px; border-top: 1px solid var(--line); }
.note { color: var(--soft); font-size: 13px; margin-top: 8px; }
.set { margin-top: 22px; break-inside: avoid; }
.three { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 10px 18px; }
.three figcaption { margin-top: 4px; }
.swatches { list-style: none; display: flex; flex-wrap: wrap; gap: 2px 14px; padding: 0; margin: 4px 0 6px; color: var(--soft); font-size: 13px; }
.swatches svg { width: 12px; height: 12px; display: inline-block; vertical-align: -1px; margin-right: 5px; outline: 1px solid #b9c1c8; }
.legends > div > svg { display: block; width: 100%; }
image { image-rendering: auto; }
@media screen and (max-width: 1060px) { .sets, .sets thead th { font-size: 12px; } .sets small, .sets thead small, .sets td small { font-size: 11px; } .sets td, .sets thead th, .sets tbody th { padding-right: 6px; } }
@media screen and (max-width: 760px) { .three { grid-template-columns: minmax(0, 1fr); } }
@media print { .kept { break-inside: avoid; } h3, .swatches { break-after: avoid; } .topic { margin: 14pt 0 4pt; } .set { margin-top: 9pt; } .three { gap: 4pt 8pt; } }
)css";

std::vector<const Run*> runs_of(const Comparison& c, std::size_t pair) {
  std::vector<const Run*> runs;
  for (const Run& run : c.runs)
    if (run.pair == pair) runs.push_back(&run);
  return runs;
}

const std::string& name_of(const Comparison& c, const Run& run) { return c.sets[run.set].name; }
std::string cell(const std::string& html) { return "<td class=\"value\">" + html + "</td>"; }
std::string best_cell(const std::string& html, bool best) {
  return best ? "<td class=\"value best\">" + html + "</td>" : cell(html);
}
std::string row_head(const std::string& name) { return "<th scope=\"row\">" + escaped(name) + "</th>"; }

std::string table(const std::vector<std::string>& columns, const std::string& rows, std::size_t words) {
  std::string head;
  for (std::size_t i = 0; i < columns.size(); ++i)
    head +=
        std::string("<th scope=\"col\"") + (i < words ? "" : " class=\"value\"") + ">" + columns[i] + "</th>";
  return "<div class=\"scroll\">\n<table class=\"sets\">\n<thead><tr>" + head + "</tr></thead>\n<tbody>\n" +
         rows + "</tbody>\n</table>\n</div>\n";
}

std::string settings(const Comparison& c, const std::string& title) {
  std::string out = "<section>\n<h2>" + title +
                    "</h2>\n<p class=\"lead\">What was chosen; every other setting is its default.</p>\n" +
                    std::string("<table class=\"numbers set\">\n<tbody>\n");
  for (const NamedSet& set : c.sets) {
    std::string words;
    std::istringstream lines(set.set.to_text());
    for (std::string line; std::getline(lines, line);) words += (words.empty() ? "" : ", ") + line;
    out += "<tr>" + row_head(set.name) + "<td>" + escaped(words) + "</td></tr>\n";
  }
  return out + "</tbody>\n</table>\n</section>\n";
}

}  // namespace sections

namespace {

using pipeline::report::counted;
using sections::escaped;
using sections::figure;

std::string facts_of(const PairFacts& pair) {
  if (pair.width_px == 0) return "nothing could be rectified";
  return std::string(pair.truth ? "The truth is known" : "No truth is known") + ". " +
         std::to_string(pair.width_px) + " × " + std::to_string(pair.height_px) + " px, " +
         (pair.rectified ? "rectified already" : "rectified") + ", disparities of " +
         figure(pair.least_px, 0) + " to " + figure(pair.most_px, 0) + " px";
}

Result<std::string> pair_section(const Comparison& c, std::size_t pair) {
  std::string out = "<section>\n<h2>" + escaped(c.pairs[pair].name) + "</h2>\n<p class=\"lead\">" +
                    facts_of(c.pairs[pair]) + "</p>\n";
  const sections::Runs runs = sections::runs_of(c, pair);
  out += sections::figures(c, runs) + sections::surfaces(c, runs) + sections::shared_pixels(c, pair);
  RELIEVO_TRY_ASSIGN(const std::string maps, sections::maps(c, pair));
  out += maps + sections::histograms(c, pair) + sections::costs(c, pair) + sections::rules(c, pair);
  RELIEVO_TRY_ASSIGN(const std::string selectors, sections::selectors(c, pair));
  return out + selectors + "</section>\n";
}

// Only what this page has; what it cannot say comes first.
std::string reading(const Comparison& c) {
  const auto any = [&c](auto&& test) { return std::ranges::any_of(c.runs, test); };
  const auto unknown =
      std::size_t(std::ranges::count_if(c.pairs, [](const PairFacts& pair) { return !pair.truth; }));
  std::string out;
  if (unknown > 0)
    out +=
        "<p><strong>No truth is known" +
        (unknown == c.pairs.size() ? std::string() : " of " + counted(int(unknown), "pair", "pairs")) +
        ".</strong> Nothing here says how wrong a set is, only how well it agrees with its own two pictures. An error that both pictures share (a wrong "
        "calibration, movement along the rows) shows in no figure.</p>\n";
  if (any([](const Run& run) { return run.score.has_value(); }))
    out +=
        "<p>A pixel is bad where its disparity is off by more than " +
        pipeline::report::number(c.limit_px, 2) +
        " px, or where there is none though the truth is known: a set cannot hide behind holes. Pixels that only the left view sees count "
        "as well; “seen by both” leaves them out.</p>\n";
  if (any([](const Run& run) { return run.left_right.has_value(); }))
    out +=
        "<p>Left-right: the pair is matched once more with the right view as the first; how far the two disparities of a place differ.</p>\n";
  if (any([](const Run& run) { return run.photo.has_value(); }))
    out +=
        "<p>Photo: the right view is predicted from the left one through the model and correlated with what the camera saw, in windows; below it how many windows the "
        "model fills: a small model has it easier.</p>\n";
  if (any([](const Run& run) { return run.epipolar_px.has_value(); }))
    out += "<p>Rows: how far matches lie off their row, rms.</p>\n";
  if (c.sets.size() > 1)
    out += "<p>The best figure of a column is green and bold, where the sets differ.</p>\n";
  return "<section class=\"reading\">\n<h2>How to read this</h2>\n" + out +
         "<p>Times are of one run, on the threads this machine has: compare them within this page only.</p>\n</section>\n";
}

}  // namespace

Result<std::string> comparison_html(const Comparison& c, const std::string& product,
                                    const std::string& made_at) {
  std::string body = pipeline::report::heading(product, "Comparison of algorithms",
                                               {escaped(made_at), counted(int(c.sets.size()), "set", "sets"),
                                                counted(int(c.pairs.size()), "pair", "pairs")});
  body += reading(c);
  for (std::size_t pair = 0; pair < c.pairs.size(); ++pair) {
    RELIEVO_TRY_ASSIGN(const std::string section, pair_section(c, pair));
    body += section;
  }
  return pipeline::report::page("Comparison of algorithms", sections::kStyle,
                                body + sections::settings(c, "The sets"));
}

}  // namespace relievo::firmware::compare
