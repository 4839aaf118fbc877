// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "firmware/compare/page/maps.h"
#include "firmware/compare/page/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"
#include "pipeline/report/text.h"

namespace relievo::firmware::compare::sections {
namespace {

using pipeline::report::Axis;
using pipeline::report::Box;
using pipeline::report::Drawing;
using pipeline::report::escaped;
using pipeline::report::figure;
using pipeline::report::figure_of;
using pipeline::report::Size;

constexpr Size kSize{480, 170};
constexpr Box kPlot{{4, 8}, {472, 118}};
constexpr double kBinPx = 2 * ErrorHistogram::kReachPx / ErrorHistogram::kBins;

double share(const DisparityScore& s, std::size_t bin) {
  return s.judged == 0 ? 0 : static_cast<double>(s.histogram.counts[bin]) / static_cast<double>(s.judged);
}

// The bins at the ends hold all that lies beyond: they are told in words, and no bars.
double tallest(const std::vector<const Run*>& runs) {
  double top = 0;
  for (const Run* run : runs)
    for (std::size_t i = 1; run->score && i + 1 < ErrorHistogram::kBins; ++i)
      top = std::max(top, share(*run->score, i));
  return std::max(top, 1e-6) * 1.04;
}

std::string of_run(const Comparison& c, const Run& run, double top) {
  const DisparityScore& s = *run.score;
  const Axis x{-ErrorHistogram::kReachPx, ErrorHistogram::kReachPx, kPlot.corner.x, kPlot.right()};
  const Axis y{0, top, kPlot.bottom(), kPlot.corner.y};
  Drawing d(kSize, name_of(c, run) + ": histogram of the errors");
  for (std::size_t i = 1; i + 1 < ErrorHistogram::kBins; ++i) {
    const double middle = -ErrorHistogram::kReachPx + (static_cast<double>(i) + 0.5) * kBinPx;
    const double left = x(middle - kBinPx / 2);
    const double high = y(share(s, i));
    const bool bad = std::abs(middle) > c.limit_px;
    if (share(s, i) > 0)
      d.filled({{left + 0.3, high}, {x(middle + kBinPx / 2) - left - 0.6, kPlot.bottom() - high}},
               bad ? hex(middle < 0 ? kTooFarColour : kTooNearColour) : "#8ba3b8");
  }
  d.line("axis", {kPlot.corner.x, kPlot.bottom()}, {kPlot.right(), kPlot.bottom()});
  for (int tick = -4; tick <= 4; tick += 2) {
    d.line("axis", {x(tick), kPlot.bottom()}, {x(tick), kPlot.bottom() + 5});
    d.text(tick == -4  ? "tick"
           : tick == 4 ? "tick end"
                       : "tick middle",
           {x(tick), kPlot.bottom() + 20}, figure(tick, 0) + (tick == 0 ? " px" : ""));
  }
  const double beyond = share(s, 0) + share(s, ErrorHistogram::kBins - 1);
  return figure_of(d.svg(), escaped(name_of(c, run)),
                   figure(100 * (1 - s.density), 1) + " % have no disparity, " + figure(100 * beyond, 1) +
                       " % lie beyond ±4 px; bias of the good ones " + figure(s.bias_px, 3) + " px.");
}

}  // namespace

std::string histograms(const Comparison& c, std::size_t pair) {
  const std::vector<const Run*> runs = runs_of(c, pair);
  const double top = tallest(runs);
  std::string out;
  for (const Run* run : runs)
    if (run->score) out += of_run(c, *run, top);
  if (out.empty()) return out;
  return "<h3 class=\"topic\">Errors</h3>\n<p class=\"lead\">Share of the pixels with known truth, a tenth of a pixel a bar; all at one scale. "
         "Left of nought too far, right too near; dark is bad.</p>\n<div class=\"pair\">\n" +
         out + "</div>\n";
}

}  // namespace relievo::firmware::compare::sections
