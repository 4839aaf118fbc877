// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "firmware/compare/page/maps.h"
#include "firmware/compare/page/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"
#include "pipeline/report/text.h"

namespace relievo::firmware::compare::sections {
namespace {

using pipeline::report::escaped;
using pipeline::report::figure;

std::string percent(std::size_t part, std::size_t whole, int decimals = 1) {
  if (whole == 0) return "–";
  return figure(100 * static_cast<double>(part) / static_cast<double>(whole), decimals);
}

// The rules of one set, the bad share before and after.
std::string rows_of(const Comparison& c, const Run& run, bool truth) {
  const MatchFigures& f = run.matches;
  std::string out;
  const auto row = [&](const std::string& head, const std::string& rule, std::size_t count,
                       std::size_t judged, std::size_t bad) {
    out += "<tr>" + row_head(head) + "<td>" + escaped(rule) + "</td>" + cell(std::to_string(count)) +
           cell(percent(count, f.matches));
    if (truth) out += cell(percent(bad, judged)) + cell(percent(bad, f.bad));
    out += "</tr>\n";
  };
  row(name_of(c, run), "all matches", f.matches, f.judged, f.bad);
  for (const RuleFigures& rule : f.rules)
    row("", "rejected: " + rule.name, rule.rejected, rule.judged, rule.bad);
  row("", "accepted", f.accepted, f.accepted_judged, f.accepted_bad);
  return out;
}

}  // namespace

std::string rules(const Comparison& c, std::size_t pair) {
  const bool truth = c.pairs[pair].truth.has_value();
  std::vector<std::string> titles{"Set", "Rule", "matches", "of all<small>%</small>"};
  if (truth)
    titles.insert(titles.end(),
                  {"truly bad<small>of these, %</small>", "holds<small>of all bad ones, %</small>"});
  std::string rows;
  for (const Run* run : runs_of(c, pair))
    if (run->matches.matches > 0 && !run->matches.rules.empty()) rows += rows_of(c, *run, truth);
  if (rows.empty()) return rows;
  return "<h3 class=\"topic\">What the constraints took away</h3>\n<p class=\"lead\">Each match is counted with the first rule that rejected it. "
         "A good rule’s rejects are bad ones.</p>\n<div class=\"scroll\">\n" +
         table_head(titles, 2) + rows + "</tbody>\n</table>\n</div>\n";
}

Result<std::string> selectors(const Comparison& c, std::size_t pair) {
  const Window window = window_of(c.pairs[pair], runs_of(c, pair));
  std::string rows;
  std::string pictures;
  for (const Run* run : runs_of(c, pair)) {
    if (!run->selector) continue;
    const SelectorFigures& s = *run->selector;
    rows +=
        "<tr>" + row_head(name_of(c, *run)) + cell(std::to_string(s.left)) + cell(std::to_string(s.right)) +
        cell(figure(s.repeatability ? 100 * *s.repeatability : std::numeric_limits<double>::quiet_NaN(), 1)) +
        cell(figure(100 * s.match_rate, 1)) +
        cell(percent(run->matches.accepted_bad, run->matches.accepted_judged)) +
        cell(figure(100 * s.spread, 1)) + "</tr>\n";
    RELIEVO_TRY_ASSIGN(const Png png, places_picture(c.pairs[pair], s, window, 480));
    const double height = 480.0 * window.height_px / std::max(1, window.width_px);
    pipeline::report::Drawing d({480, height}, name_of(c, *run) + ": chosen places");
    d.picture({{0, 0}, {480, height}}, png);
    pictures +=
        pipeline::report::figure_of(d.svg(), escaped(name_of(c, *run)), std::to_string(s.left) + " places");
  }
  if (rows.empty()) return rows;
  return "<h3 class=\"topic\">Where is it worth matching?</h3>\n<p class=\"lead\">Selectors that choose places. Repeated: of the places both views see, "
         "those chosen again within 1.5 px in the right view. Spread: share of 16 × 16 cells of the region that hold a place.</p>\n<div class=\"scroll\">\n" +
         table_head({"Set", "places<small>left</small>", "places<small>right</small>",
                     "repeated<small>%</small>", "matched<small>%</small>",
                     "bad<small>of the matched, %</small>", "spread<small>%</small>"}) +
         rows + "</tbody>\n</table>\n</div>\n<div class=\"three places\">\n" + pictures + "</div>\n";
}

std::string shared_pixels(const Comparison& c, std::size_t pair) {
  constexpr std::size_t kMost = 9;  // columns that a page holds; the JSON has all
  std::vector<const Run*> runs = runs_of(c, pair);
  runs.erase(std::remove_if(runs.begin(), runs.end(),
                            [](const Run* run) { return !run->score || run->score->given == 0; }),
             runs.end());
  if (runs.size() < 2 || runs.size() > kMost) return {};
  std::vector<std::string> titles{"Set"};
  for (const Run* run : runs) titles.push_back("beside " + escaped(name_of(c, *run)));
  std::string out =
      "<h3 class=\"topic\">Where both give a disparity</h3>\n<p class=\"lead\">Bad pixels, in percent, of the row’s set and, after the stroke, of the "
      "column’s, on the pixels that both give: who leaves the difficult ones out gains nothing here.</p>\n<div class=\"scroll\">\n" +
      table_head(titles);
  for (const Run* one : runs) {
    out += "<tr>" + row_head(name_of(c, *one));
    for (const Run* other : runs) {
      const SharedScore s =
          one == other ? SharedScore{} : score_shared(one->map, other->map, *c.pairs[pair].truth, c.limit_px);
      out += s.shared == 0 ? cell("–")
                           : best_cell(figure(100 * s.bad_one, 2) + " / " + figure(100 * s.bad_other, 2),
                                       s.bad_one + 5e-5 < s.bad_other);  // as it reads
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

}  // namespace relievo::firmware::compare::sections
