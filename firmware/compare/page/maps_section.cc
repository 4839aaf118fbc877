// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "firmware/compare/page/maps.h"
#include "firmware/compare/page/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"
#include "pipeline/report/text.h"

namespace relievo::firmware::compare::sections {
namespace {

using pipeline::report::Drawing;
using pipeline::report::escaped;
using pipeline::report::figure;
using pipeline::report::figure_of;

constexpr int kWidthPx = 480;
constexpr int kDotPx = 9;  // of scattered matches, in pixels of the map

std::string drawn(const Window& window, const Png& png, const std::string& says, const std::string& title,
                  const std::string& caption) {
  const double height = static_cast<double>(kWidthPx) * window.height_px / std::max(1, window.width_px);
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
    d.text(styles[i], {240.0 * static_cast<double>(i), 32}, words[i]);
  return d.svg();
}

std::string swatch(Rgb colour, const std::string& words) {
  Drawing d({14, 14}, words);
  d.filled({{0, 0}, {14, 14}}, hex(colour));
  return "<li>" + d.svg() + escaped(words) + "</li>";
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

}  // namespace

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
  out += drawn(window, disparities, name + ": disparities", "",
               figure(100.0 *
                          static_cast<double>(std::count_if(run.map.values.begin(), run.map.values.end(),
                                                            [](float d) { return !std::isnan(d); })) /
                          static_cast<double>(std::max<std::size_t>(1, run.map.values.size())),
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

}  // namespace relievo::firmware::compare::sections
