// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/score_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"

namespace relievo::bench {
namespace {

using namespace pipeline::report;  // NOLINT: a page of the bench
using pipeline::Vec2d;

constexpr Size kSize{480, 380};
constexpr Box kPlot{{58, 48}, {408, 272}};
constexpr std::array<double, 9> kTicksMm{0.05, 0.1, 0.2, 0.3, 0.5, 1, 2, 3, 5};

// Logarithm of the distance, over what occurs.
struct Range {
  double low = 0, high = 1;
};
Range range_of(std::span<const Score> scores) {
  double least = 1e9, most = 0;
  for (const Score& s : scores) {
    if (!s.rms_mm) continue;
    least = std::min(least, *s.rms_mm);
    most = std::max(most, *s.rms_mm);
  }
  if (!(most > 0)) return {std::log(0.05), std::log(5.0)};
  return {std::log(std::max(least, 1e-3)) - 0.1, std::log(std::max(most, 2e-3)) + 0.1};
}

void axes(Drawing& d, const Axis& x, const Axis& y, const std::string& label) {
  const double step = tick_step(y.high, 5);
  for (int k = 0; k * step <= y.high * 1.001; ++k) {
    const double at = y(k * step);
    d.line(k == 0 ? "axis" : "grid", {kPlot.corner.x, at}, {kPlot.right(), at});
    d.text("tick end", {kPlot.corner.x - 8, at + 4.5},
           figure(100 * k * step, std::max(0, tick_decimals(step) - 2)));
  }
  for (const double mm : kTicksMm) {
    if (std::log(mm) < x.low || std::log(mm) > x.high) continue;
    d.line("axis", {x(std::log(mm)), kPlot.bottom()}, {x(std::log(mm)), kPlot.bottom() + 5});
    d.text("tick middle", {x(std::log(mm)), kPlot.bottom() + 20}, number(mm, 2));
  }
  d.text("label middle", {0.5 * (kPlot.corner.x + kPlot.right()), kSize.height - 14},
         "distance between the surfaces, mm");
  d.text("label begin", {4, 16}, label);
}

void key(Drawing& d, std::string_view same, std::string_view different) {
  const double y = kPlot.corner.y - 12;
  d.box("bar left", {{170, y - 11}, {14, 12}});
  d.text("tick begin", {190, y}, same);
  d.box("bar right", {{310, y - 11}, {14, 12}});
  d.text("tick begin", {330, y}, different);
}

}  // namespace

std::string_view score_figures_style() {
  return "svg .series.left { stroke: var(--left); } svg .series.right { stroke: var(--right); } .tiles .large { font-size: 23px; }";
}

std::string distribution_figure(std::span<const Score> scores) {
  constexpr int kBars = 48;
  const Range range = range_of(scores);
  std::array<std::array<double, kBars>, 2> share{};
  std::array<double, 2> count{};
  for (const Score& s : scores) count[s.same() ? 0 : 1] += s.rms_mm ? 1 : 0;
  double most = 0.01;
  for (const Score& s : scores) {
    if (!s.rms_mm) continue;
    const int bar = std::clamp(
        static_cast<int>((std::log(*s.rms_mm) - range.low) / (range.high - range.low) * kBars), 0, kBars - 1);
    double& sum = share[s.same() ? 0 : 1][static_cast<std::size_t>(bar)];
    sum += 1 / count[s.same() ? 0 : 1];
    most = std::max(most, sum);
  }
  Drawing d(kSize, "Histogram of the distances of same and different persons");
  const Axis x{range.low, range.high, kPlot.corner.x, kPlot.right()},
      y{0, 1.05 * most, kPlot.bottom(), kPlot.corner.y};
  axes(d, x, y, "share of the comparisons, %");
  const double width = kPlot.size.width / kBars;
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::size_t bar = 0; bar < kBars; ++bar)
      if (share[kind][bar] > 0) {
        const double top = y(share[kind][bar]);
        d.box(kind == 0 ? "bar left" : "bar right",
              {{kPlot.corner.x + width * static_cast<double>(bar), top}, {width, kPlot.bottom() - top}});
      }
  key(d, "same person", "different persons");
  return d.svg();
}

std::string rates_figure(std::span<const Score> scores) {
  const Range range = range_of(scores);
  const std::vector<ErrorRates> rates = error_rates(scores);
  constexpr double kTop = 0.2;  // above it no one would draw a line
  Drawing d(kSize, "False match and false non-match rates over the threshold");
  const Axis x{range.low, range.high, kPlot.corner.x, kPlot.right()},
      y{0, kTop, kPlot.bottom(), kPlot.corner.y};
  axes(d, x, y, "share that is judged wrongly, %");
  for (const bool same : {true, false}) {
    Strokes strokes;
    double before = -1e9;
    for (const ErrorRates& r : rates) {
      const double rate = same ? r.false_non_match : r.false_match, at = x(std::log(r.threshold_mm));
      if (rate > kTop || at - before < 0.3) continue;
      before = at;
      strokes.empty() ? strokes.from({at, y(rate)}) : strokes.to({at, y(rate)});
    }
    d.strokes(same ? "series left" : "series right", strokes);
  }
  key(d, "same, rejected", "different, accepted");
  return d.svg();
}

}  // namespace relievo::bench
