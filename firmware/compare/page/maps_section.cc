// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/compare/page/sections.h"

namespace relievo::firmware::compare::sections {
namespace {

constexpr int kWidthPx = 480;
constexpr int kDotPx = 9;  // of scattered matches, in pixels of the map

std::string drawn(const Window& window, const Png& png, const std::string& says, const std::string& title,
                  const std::string& caption) {
  const double height = double(kWidthPx) * window.height_px / std::max(1, window.width_px);
  Drawing d({kWidthPx, height}, says);
  d.picture({{0, 0}, {kWidthPx, height}}, png);
  return figure_of(d.svg(), title, caption);
}

// A strip of colours with its ends and middle named.
template <typename Colour>
std::string strip(const std::string& says, const std::vector<std::string>& words, Colour&& colour) {
  constexpr int kShades = 96;
  Drawing d({480, 40}, says);
  for (int i = 0; i < kShades; ++i) d.filled({{i * 5.0, 0}, {5.2, 14}}, hex(colour((i + 0.5) / kShades)));
  const char* const styles[] = {"tick", "tick middle", "tick end"};
  for (std::size_t i = 0; i < words.size() && i < 3; ++i)
    d.text(styles[i], {240.0 * double(i), 32}, words[i]);
  return d.svg();
}

std::string legend(const Comparison& c, const PairFacts& pair, const Reach& reach) {
  const std::string least = figure(reach.least_px, 0) + " px, far";
  const std::string most = figure(reach.most_px, 0) + " px, near";
  std::string out =
      "<div class=\"pair legends\">\n<div><h3>Disparity</h3>" +
      strip("colours of the disparities", {least, "", most}, [](double t) { return depth_colour(t); }) +
      "<ul class=\"swatches\">" + swatch(kHoleColour, "no disparity") + "</ul></div>\n";
  if (pair.truth) {
    const std::string limit = pipeline::report::number(c.limit_px, 2) + " px";
    out += "<div><h3>Error</h3>" +
           strip("colours of the errors", {"−" + limit, "exact", "+" + limit},
                 [&c](double t) { return error_colour((2 * t - 1) * c.limit_px * 0.999, c.limit_px); }) +
           "<ul class=\"swatches\">" + swatch(kTooFarColour, "bad: too far") +
           swatch(kTooNearColour, "bad: too near") + swatch(kMissedColour, "bad: no disparity") +
           swatch(kUnknownColour, "no truth") + "</ul></div>\n";
  }
  return out + "</div>\n";
}

std::string rule_legend(const Run& run) {
  std::string out;
  for (std::size_t i = 0; i < run.matches.rules.size(); ++i)
    if (run.matches.rules[i].rejected > 0) out += swatch(rule_colour(i), run.matches.rules[i].name);
  return out.empty() ? "Nothing was rejected."
                     : "<span>Rejected matches, by rule</span><ul class=\"swatches\">" + out + "</ul>";
}

// Sets that differ in what comes after matching have the same matches: they are drawn once.
bool same_matches(const Run& a, const Run& b) {
  const auto same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.rejected_by == b.rejected_by &&
         std::equal(a.map.values.begin(), a.map.values.end(), b.map.values.begin(), b.map.values.end(), same);
}

// Of the truth, or of the first set that matched.
Reach reach_of_pair(const Comparison& c, std::size_t index) {
  const PairFacts& pair = c.pairs[index];
  if (pair.truth) return reach_of(pair.truth->map);
  for (const Run* run : runs_of(c, index))
    if (run->matches.accepted > 0) return reach_of(run->map);
  return {pair.least_px, pair.most_px};
}

std::string percent(std::size_t part, std::size_t whole) {
  if (whole == 0) return "–";
  return figure(100 * double(part) / double(whole), 1);
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

std::string swatch(Rgb colour, const std::string& words) {
  Drawing d({14, 14}, words);
  d.filled({{0, 0}, {14, 14}}, hex(colour));
  return "<li>" + d.svg() + escaped(words) + "</li>";
}

Result<std::string> ground(const Comparison& c, std::size_t index) {
  const PairFacts& pair = c.pairs[index];
  if (pair.width_px == 0) return std::string();
  const Window window = window_of(pair, runs_of(c, index));
  const Reach reach = reach_of_pair(c, index);
  std::string out = legend(c, pair, reach) + "<div class=\"pair\">\n";
  RELIEVO_TRY_ASSIGN(const Png grey, grey_picture(pair, window, kWidthPx));
  out += drawn(window, grey, "the left view", "Left view",
               "as the matchers are given it, before any preprocessing");
  if (pair.truth) {
    RELIEVO_TRY_ASSIGN(const Png truth, disparity_picture(pair.truth->map, reach, window, kWidthPx));
    out += drawn(window, truth, "the true disparities", "Truth", "what every set is judged by");
  }
  return out + "</div>\n";
}

Result<std::string> map_row(const Comparison& c, const Run& run, const std::string& name) {
  const PairFacts& pair = c.pairs[run.pair];
  const Window window = window_of(pair, runs_of(c, run.pair));
  const Reach reach = reach_of_pair(c, run.pair);
  const bool scattered = run.selector.has_value();
  const DisparityMap shown = scattered ? thickened(run.map, kDotPx) : run.map;
  RELIEVO_TRY_ASSIGN(const Png disparities, disparity_picture(shown, reach, window, kWidthPx));
  RELIEVO_TRY_ASSIGN(const Png rejected, rejected_picture(pair, run, window, kWidthPx));
  std::string out = "<div class=\"set\">\n<h3>" + escaped(name) + "</h3>\n<div class=\"three\">\n";
  out += drawn(
      window, disparities, name + ": disparities", "",
      figure(100.0 * double(std::ranges::count_if(run.map.values, [](float d) { return !std::isnan(d); })) /
                 double(std::max<std::size_t>(1, run.map.values.size())),
             1) +
          " % of the picture have one");
  if (run.score) {
    RELIEVO_TRY_ASSIGN(const Png errors, error_picture(shown, *pair.truth, c.limit_px, window, kWidthPx));
    out +=
        drawn(window, errors, name + ": errors", "",
              (scattered ? figure(100 * run.score->bad_given, 2) + " % of the matches are bad, median error "
                         : figure(100 * run.score->bad_limit, 2) + " % bad, median error ") +
                  figure(run.score->median_px, 3) + " px");
  }
  out += drawn(window, rejected, name + ": rejected matches", "", rule_legend(run));
  return out + "</div>\n</div>\n";
}

Result<std::string> maps(const Comparison& c, std::size_t index) {
  RELIEVO_TRY_ASSIGN(std::string out, ground(c, index));
  if (out.empty()) return out;
  out.insert(0, "<h3 class=\"topic\">Maps</h3>\n");
  Runs left = runs_of(c, index);
  std::erase_if(left, [](const Run* run) { return run->map.values.empty(); });
  while (!left.empty()) {
    const Run& first = *left.front();
    std::string names;
    std::erase_if(left, [&](const Run* run) {
      const bool same = same_matches(first, *run);
      if (same) names += (names.empty() ? "" : ", ") + name_of(c, *run);
      return same;
    });
    RELIEVO_TRY_ASSIGN(const std::string row, map_row(c, first, names));
    out += row;
  }
  return out;
}

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
         "A good rule’s rejects are bad ones.</p>\n" +
         table(titles, rows, 2);
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
    RELIEVO_TRY_ASSIGN(const Png png, places_picture(c.pairs[pair], s, window, kWidthPx));
    pictures += drawn(window, png, name_of(c, *run) + ": chosen places", escaped(name_of(c, *run)),
                      std::to_string(s.left) + " places");
  }
  if (rows.empty()) return rows;
  return "<h3 class=\"topic\">Where is it worth matching?</h3>\n<p class=\"lead\">Selectors that choose places. Repeated: of the places both views see, "
         "those chosen again within 1.5 px in the right view. Spread: share of 16 × 16 cells of the region that hold a place.</p>\n" +
         table({"Set", "places<small>left</small>", "places<small>right</small>", "repeated<small>%</small>",
                "matched<small>%</small>", "bad<small>of the matched, %</small>", "spread<small>%</small>"},
               rows) +
         "<div class=\"three places\">\n" + pictures + "</div>\n";
}

std::string shared_pixels(const Comparison& c, std::size_t pair) {
  constexpr std::size_t kMost = 9;  // columns that a page holds; the JSON has all
  std::vector<const Run*> runs = runs_of(c, pair);
  std::erase_if(runs, [](const Run* run) { return !run->score || run->score->given == 0; });
  if (runs.size() < 2 || runs.size() > kMost) return {};
  std::vector<std::string> titles{"Set"};
  for (const Run* run : runs) titles.push_back("beside " + escaped(name_of(c, *run)));
  std::string out;
  const char* const title =
      "<h3 class=\"topic\">Where both give a disparity</h3>\n<p class=\"lead\">Bad pixels, in percent, of the row’s set and, after the stroke, of the "
      "column’s, on the pixels that both give: who leaves the difficult ones out gains nothing here.</p>\n";
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
  return title + table(titles, out);
}

}  // namespace relievo::firmware::compare::sections
