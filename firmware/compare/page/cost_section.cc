// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string_view>

#include "firmware/compare/page/maps.h"
#include "firmware/compare/page/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::firmware::compare::sections {
namespace {

using pipeline::report::Drawing;
using pipeline::report::figure;

constexpr std::array<std::string_view, 9> kSteps{"rectify",     "preprocess", "select",  "match",   "judge",
                                                 "reconstruct", "mesh",       "texture", "assemble"};
constexpr double kMiB = 1048576;

double total_of(const Run& run) {
  double ms = 0;
  for (const StageCost& stage : run.stages) ms += stage.ms;
  return ms;
}

double of_step(const Run& run, std::string_view step) {
  for (const StageCost& stage : run.stages)
    if (stage.name == step) return stage.ms;
  return 0;
}

Rgb step_colour(std::size_t step) { return rule_colour(step); }

// All steps of a run, one after the other.
std::string bar(const Run& run, double longest_ms) {
  Drawing d({360, 16}, "times of the steps");
  double at = 0;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const double width = of_step(run, kSteps[i]) / std::max(longest_ms, 1e-9) * 360;
    if (width > 0) d.filled({{at, 1}, {std::max(width, 0.3), 14}}, hex(step_colour(i)));
    at += width;
  }
  return d.svg();
}

std::string swatches(const std::vector<const Run*>& runs) {
  std::string out;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    if (std::none_of(runs.begin(), runs.end(), [i](const Run* run) { return of_step(*run, kSteps[i]) > 0; }))
      continue;
    Drawing d({14, 14}, kSteps[i]);
    d.filled({{0, 0}, {14, 14}}, hex(step_colour(i)));
    out += "<li>" + d.svg() + std::string(kSteps[i]) + "</li>";
  }
  return "<ul class=\"swatches\">" + out + "</ul>\n";
}

}  // namespace

std::string costs(const Comparison& c, std::size_t pair) {
  const std::vector<const Run*> runs = runs_of(c, pair);
  double longest = 0;
  for (const Run* run : runs) longest = std::max(longest, total_of(*run));
  std::vector<std::string> titles{"Set", "all steps<small>to scale</small>"};
  std::vector<std::string_view> steps;
  for (const std::string_view step : kSteps)
    if (std::any_of(runs.begin(), runs.end(), [step](const Run* run) { return of_step(*run, step) > 0; }))
      steps.push_back(step);
  for (const std::string_view step : steps) titles.push_back(std::string(step) + "<small>ms</small>");
  titles.insert(titles.end(), {"arenas<small>peak, MiB</small>", "heap<small>peak, MiB</small>"});
  std::string out = "<h3 class=\"topic\">Time and memory</h3>\n" + swatches(runs) +
                    "<div class=\"scroll\">\n" + table_head(titles, 2);
  for (const Run* run : runs) {
    out += "<tr>" + row_head(name_of(c, *run)) + "<td class=\"bars\">" + bar(*run, longest) + "</td>";
    for (const std::string_view step : steps) out += cell(figure(of_step(*run, step), 0));
    out +=
        cell(figure(static_cast<double>(run->arena_peak_bytes) / kMiB, 0)) +
        cell(run->heap_peak_bytes == 0 ? "–" : figure(static_cast<double>(run->heap_peak_bytes) / kMiB, 0)) +
        "</tr>\n";
  }
  return out +
         "</tbody>\n</table>\n</div>\n<p class=\"note\">Arenas: what the algorithms took of the memory planned for them. Heap: what the process "
         "held besides at the worst moment, above what it held before.</p>\n";
}

}  // namespace relievo::firmware::compare::sections
