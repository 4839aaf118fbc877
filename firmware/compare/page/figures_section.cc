// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "firmware/compare/page/sections.h"

namespace relievo::firmware::compare::sections {
namespace {

using pipeline::report::Axis;
using pipeline::report::Box;
using pipeline::report::Size;

// A column: what of a run, how many decimals, whether less is better.
struct Column {
  std::string title;
  std::function<double(const Run&)> value;
  int decimals;
  enum class Better { Less, More, Neither } better;
  std::function<std::string(const Run&)> beside = {};  // said below a value
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A figure of a part that a run may have, `times` so much.
template <typename Part>
auto of(std::optional<Part> Run::*part, double Part::*figure, double times = 1) {
  return [=](const Run& r) { return r.*part ? times * (*(r.*part)).*figure : kNone; };
}

std::vector<Column> disparity_columns(const std::string& limit) {
  using B = Column::Better;
  using S = DisparityScore;
  return {{"bad<small>off by more than " + limit + "&nbsp;px, or a hole; %</small>",
           of(&Run::score, &S::bad_limit, 100), 2, B::Less},
          {"bad, seen by both<small>%</small>", of(&Run::score, &S::bad_seen, 100), 2, B::Less},
          {"bad of the given<small>%</small>", of(&Run::score, &S::bad_given, 100), 2, B::Less},
          {"density<small>%</small>", of(&Run::score, &S::density, 100), 1, B::More},
          {"median<small>error, px</small>", of(&Run::score, &S::median_px), 3, B::Less},
          {"mean<small>px</small>", of(&Run::score, &S::mean_px), 2, B::Less},
          {"rms<small>px</small>", of(&Run::score, &S::rms_px), 2, B::Less}};
}

std::vector<Column> model_columns() {
  using B = Column::Better;
  using M = measure::Measurement;
  return {
      {"interior<small>median, mm</small>", of(&Run::model, &M::interior_median_mm), 3, B::Less},
      {"face within<small>95&nbsp;%, mm</small>", of(&Run::model, &M::accuracy_p95_mm), 2, B::Less},
      {"complete<small>within 0.5&nbsp;mm, %</small>", of(&Run::model, &M::complete_half_mm, 100), 1,
       B::More},
      {"off<small>over 3&nbsp;mm, %</small>", of(&Run::model, &M::outliers_3mm, 100), 2, B::Less},
      {"in one sigma<small>68 is honest, %</small>", of(&Run::model, &M::within_sigma, 100), 0, B::Neither}};
}

std::vector<Column> common_columns() {
  using B = Column::Better;
  return {{"matched<small>accepted</small>",
           [](const Run& r) { return r.matches.matches == 0 ? kNone : double(r.matches.accepted); }, 0,
           B::Neither},
          {"time<small>to match, ms</small>",
           [](const Run& r) { return r.matches.matches == 0 ? kNone : r.match_ms; }, 0, B::Less},
          {"time<small>to mesh, ms</small>", of(&Run::surface, &SurfaceLook::mesh_ms), 0, B::Less}};
}

// What needs no truth.
std::vector<Column> own_columns() {
  using B = Column::Better;
  return {
      {"left-right<small>median, px</small>", of(&Run::left_right, &LeftRightFigures::median_px), 3, B::Less},
      {"agree<small>left and right within 1&nbsp;px, %</small>",
       of(&Run::left_right, &LeftRightFigures::within_1px, 100), 1, B::More},
      {"photo<small>right view predicted, correlation</small>", of(&Run::photo, &PhotoFigures::median), 3,
       B::More,
       [](const Run& r) { return pipeline::report::counted(int(r.photo->asked), "window", "windows"); }},
      {"rows<small>disagree by, px</small>", [](const Run& r) { return r.epipolar_px.value_or(kNone); }, 3,
       B::Less}};
}

void leave_out_empty(const std::vector<const Run*>& runs, std::vector<Column>& columns) {
  std::erase_if(columns, [&runs](const Column& column) {
    return std::ranges::all_of(runs, [&column](const Run* run) { return std::isnan(column.value(*run)); });
  });
}

// None where all read the same.
double best_of(const std::vector<const Run*>& runs, const Column& column) {
  double best = kNone;
  bool differ = false;
  const Run* first = nullptr;
  for (const Run* run : runs) {
    const double value = column.value(*run);
    if (std::isnan(value) || !run->failure.empty() || column.better == Column::Better::Neither) continue;
    if (first == nullptr) first = run;
    differ = differ || figure(value, column.decimals) != figure(column.value(*first), column.decimals);
    const bool better = column.better == Column::Better::Less ? value < best : value > best;
    if (std::isnan(best) || better) best = value;
  }
  return differ ? best : kNone;
}

// A set of which the columns know nothing says why instead; one that failed later does so below its row.
std::string table(const Comparison& c, const std::vector<const Run*>& runs,
                  const std::vector<Column>& columns, bool say_failures) {
  std::vector<std::string> titles{"Set"};
  std::vector<double> best;
  for (const Column& column : columns) {
    titles.push_back(column.title);
    best.push_back(runs.size() > 1 ? best_of(runs, column) : kNone);
  }
  const std::string width =
      "<td class=\"failed\" colspan=\"" + std::to_string(std::max<std::size_t>(1, columns.size())) + "\">";
  std::string out;
  for (const Run* run : runs) {
    out += "<tr>" + row_head(name_of(c, *run));
    bool nothing = true;
    for (const Column& column : columns) nothing = nothing && std::isnan(column.value(*run));
    const std::string& why = run->failure.empty() ? run->no_surface : run->failure;
    if (nothing) out += width + escaped(why) + "</td>";
    for (std::size_t i = 0; i < columns.size() && !nothing; ++i) {
      const double value = columns[i].value(*run);
      const std::string beside =
          columns[i].beside && !std::isnan(value) ? "<small>" + columns[i].beside(*run) + "</small>" : "";
      out += best_cell(figure(value, columns[i].decimals) + beside, value == best[i]);
    }
    out += "</tr>\n";
    if (say_failures && !nothing && !why.empty())
      out += "<tr><th scope=\"row\"></th>" + width + escaped(why) + "</td></tr>\n";
  }
  return sections::table(titles, out);
}

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

// All steps of a run, one after the other.
std::string bar(const Run& run, double longest_ms) {
  Drawing d({360, 16}, "times of the steps");
  double at = 0;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const double width = of_step(run, kSteps[i]) / std::max(longest_ms, 1e-9) * 360;
    if (width > 0) d.filled({{at, 1}, {std::max(width, 0.3), 14}}, hex(rule_colour(i)));
    at += width;
  }
  return d.svg();
}

std::string swatches(const std::vector<const Run*>& runs) {
  std::string out;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    if (std::ranges::none_of(runs, [i](const Run* run) { return of_step(*run, kSteps[i]) > 0; })) continue;
    out += swatch(rule_colour(i), std::string(kSteps[i]));
  }
  return "<ul class=\"swatches\">" + out + "</ul>\n";
}

std::string facts_of(const Run& run) {
  const SurfaceLook& look = *run.surface;
  std::string facts =
      figure(look.mesh_ms, 0) + " ms to mesh, " + std::to_string(look.triangles) + " triangles, " +
      figure(100 * double(look.measured) / double(std::max<std::size_t>(1, look.vertices)), 0) +
      " % of the vertices measured";
  if (run.model)
    facts += "; interior median " + figure(run.model->interior_median_mm, 3) + " mm, " +
             figure(100 * run.model->complete_half_mm, 1) + " % within 0.5 mm";
  return facts;
}

constexpr Size kSize{480, 170};
constexpr Box kPlot{{4, 8}, {472, 118}};
constexpr double kBinPx = 2 * ErrorHistogram::kReachPx / ErrorHistogram::kBins;

double share(const DisparityScore& s, std::size_t bin) {
  return s.judged == 0 ? 0 : double(s.histogram.counts[bin]) / double(s.judged);
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
    const double middle = -ErrorHistogram::kReachPx + (double(i) + 0.5) * kBinPx;
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

std::string figures(const Comparison& c, const Runs& runs) {
  const auto any = [&runs](auto&& test) { return std::ranges::any_of(runs, test); };
  std::string out;
  const bool models = any([](const Run* r) { return r->model.has_value(); });
  const bool scores = any([](const Run* r) { return r->score.has_value(); });
  if (models)
    out += "<h3>The model, against the true surface</h3>\n" + table(c, runs, model_columns(), false);
  if (scores)
    out += (models ? "<h3 class=\"topic\">" : "<h3>") +
           std::string("The disparities, against the true ones</h3>\n") +
           table(c, runs, disparity_columns(pipeline::report::number(c.limit_px, 2)), !models);
  std::vector<Column> columns = own_columns();
  for (Column& column : common_columns()) columns.push_back(std::move(column));
  leave_out_empty(runs, columns);
  if (columns.empty() && scores) return out;
  return out + (scores ? "<h3 class=\"topic\">What needs no truth</h3>\n" : "") +
         table(c, runs, columns, !scores);
}

std::string costs(const Comparison& c, std::size_t pair) {
  const std::vector<const Run*> runs = runs_of(c, pair);
  double longest = 0;
  for (const Run* run : runs) longest = std::max(longest, total_of(*run));
  std::vector<std::string> titles{"Set", "all steps<small>to scale</small>"};
  std::vector<std::string_view> steps;
  for (const std::string_view step : kSteps)
    if (std::ranges::any_of(runs, [step](const Run* run) { return of_step(*run, step) > 0; }))
      steps.push_back(step);
  for (const std::string_view step : steps) titles.push_back(std::string(step) + "<small>ms</small>");
  titles.insert(titles.end(), {"arenas<small>peak, MiB</small>", "heap<small>peak, MiB</small>"});
  std::string out;
  for (const Run* run : runs) {
    out += "<tr>" + row_head(name_of(c, *run)) + "<td class=\"bars\">" + bar(*run, longest) + "</td>";
    for (const std::string_view step : steps) out += cell(figure(of_step(*run, step), 0));
    out += cell(figure(double(run->arena_peak_bytes) / kMiB, 0)) +
           cell(run->heap_peak_bytes == 0 ? "–" : figure(double(run->heap_peak_bytes) / kMiB, 0)) + "</tr>\n";
  }
  return "<div class=\"kept\">\n<h3 class=\"topic\">Time and memory</h3>\n" + swatches(runs) +
         sections::table(titles, out, 2) +
         "</div>\n<p class=\"note\">Arenas: what the algorithms took of the memory planned for them. Heap: what the process "
         "held besides at the worst moment, above what it held before.</p>\n";
}

std::string surfaces(const Comparison& c, const Runs& runs) {
  std::string out;
  for (const Run* run : runs) {
    if (!run->surface) continue;
    Drawing d({480, 240}, name_of(c, *run) + ": its surface from in front and from the side");
    d.picture({{0, 0}, {240, 240}}, run->surface->front);
    d.picture({{240, 0}, {240, 240}}, run->surface->side);
    out += figure_of(d.svg(), escaped(name_of(c, *run)), facts_of(*run));
  }
  if (out.empty()) return out;
  return "<h3 class=\"topic\">Surfaces</h3>\n<p class=\"lead\">Each set’s model in plain shading, from in "
         "front and turned by 50°, all at one scale.</p>\n<div class=\"pair\">\n" +
         out + "</div>\n";
}

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
