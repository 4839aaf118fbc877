// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdlib>

#include "firmware/compare/page/compare_page.h"
#include "firmware/compare/page/sections.h"

namespace relievo::firmware::compare {

std::vector<Figure> figures_of(const Dissertation& d) {
  const auto runs = [](const Comparison& c, std::initializer_list<std::size_t> which) {
    std::vector<const Run*> some;
    for (const std::size_t i : which) some.push_back(&c.runs[i]);
    return some;
  };
  std::vector<Figure> all{{6, "SSD and ZMNCC", d.rules, runs(d.rules, {0, 1, d.rules.runs.size() - 1})}};
  for (std::size_t i = 0; i < kDissertationRules.size(); ++i)
    all.push_back({int(7 + i), "the " + std::string(kDissertationRules[i]) + " constraint", d.rules,
                   runs(d.rules, {2 + i})});
  all.push_back({17, "the fully automatic face", d.face, runs(d.face, {0, 1, 2, 3})});
  return all;
}

namespace {

using sections::cell, sections::escaped, sections::figure, sections::row_head, sections::table;

constexpr std::string_view kTitle = "The dissertation, done again";
constexpr std::string_view kStyle = R"css(
.beside { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 14px 40px; align-items: start; margin-top: 10px; }
.beside > div { border-top: 3px solid var(--line); padding-top: 10px; } .beside > .ours { border-color: var(--left); }
.beside p { max-width: 60ch; }
.seen { margin: 16px 0 0; padding: 10px 14px; background: var(--wash); border-radius: 6px; }
.ours + .wide, .wide { margin-top: 18px; }
@media screen and (max-width: 760px) { .beside { grid-template-columns: minmax(0, 1fr); } }
@media print { section { break-inside: avoid; } }
)css";
constexpr const char* kUnknown = "not recorded";

std::string percent_of(double share) { return figure(100 * share, 1) + " %"; }
std::string percent_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? "–" : percent_of(double(part) / double(whole));
}
std::string off_by(double found, double truth, int decimals) {
  return (found > truth ? "+" : "") + figure(found - truth, decimals);
}

std::string row(const std::string& name, const std::vector<std::string>& cells) {
  std::string out = "<tr>" + row_head(name);
  for (const std::string& text : cells) out += cell(text);
  return out + "</tr>\n";
}
// "Table 1: ...": what the dissertation shows, what we find, what the reader sees, and what is too wide to
// stand in half a page.
struct Entry {
  std::string id, title, theirs, ours, seen, wide;
};
std::string section(const Entry& e) {
  return "<section id=\"" + e.id + "\">\n<h2>" + e.title +
         "</h2>\n<div class=\"beside\">\n<div class=\"theirs\">\n<h3>Dissertation</h3>\n" + e.theirs +
         "</div>\n<div class=\"ours\">\n<h3>Relievo</h3>\n" + e.ours + "</div>\n</div>\n<p class=\"seen\">" +
         e.seen + "</p>\n<div class=\"wide\">\n" + e.wide + "</div>\n</section>\n";
}

std::string table_1(const RigTable& rig) {
  const std::vector<std::string> titles{"", "true", "calibrated", "off by"};
  using namespace recorded;
  const auto focal = [](double px) { return row("focal length, px", {kUnknown, figure(px, 1), "–"}); };
  Entry e{"table-1", "Table 1: a virtual rig is calibrated", {}, {}, {}, {}};
  e.theirs = table(titles, row("baseline, units", {figure(kBaselineUnits, 3), figure(kFoundBaselineUnits, 3),
                                                   off_by(kFoundBaselineUnits, kBaselineUnits, 3)}) +
                               focal(kFoundFocalPx[0]) + focal(kFoundFocalPx[1]));
  std::string rows = row("baseline, units", {figure(kBaselineUnits, 3), figure(rig.baseline_units, 3),
                                             off_by(rig.baseline_units, kBaselineUnits, 3)});
  for (const double px : rig.focal_px)
    rows += row("focal length, px",
                {figure(rig.true_focal_px, 1), figure(px, 1), off_by(px, rig.true_focal_px, 1)});
  e.ours = table(titles, rows);
  e.seen = "The baseline is off by " + figure(std::abs(rig.baseline_units - kBaselineUnits), 3) +
           " units where the dissertation’s was off by " +
           figure(std::abs(kFoundBaselineUnits - kBaselineUnits), 3) + ".";
  e.wide =
      "<p class=\"note\">Ours: eight boards photographed by a simulated rig of 640 × 480 px, lens distortion and "
      "noise included; the pair’s rms is " +
      figure(rig.pair_rms_px, 3) +
      " px. A unit is 10 mm. Which of its cameras each of its focal lengths "
      "belongs to is not recorded.</p>\n";
  return section(e);
}

std::string table_2(const CubeTable& cube) {
  using namespace recorded;
  const std::vector<std::string> titles{"", "units"};
  const auto rows = [&titles](const std::string& worst, const std::string& rms, const std::string& truth,
                              const std::string& side) {
    return table(titles, row("worst corner, off by", {worst}) + row("corners, rms of 100 hands", {rms}) +
                             row("side of the cube, true", {truth}) + row("side of the cube, found", {side}) +
                             row("distance", {figure(kDistanceUnits, 0)}));
  };
  Entry e{"table-2", "Table 2: a cube, matched by hand", {}, {}, {}, {}};
  e.theirs =
      rows("within " + figure(kWorstCornerUnits, 0), kUnknown, "about " + figure(kCubeUnits, 0), kUnknown) +
      "<p class=\"note\">The coordinates of its corners are not recorded here.</p>\n";
  e.ours = rows(figure(cube.worst_units, 2), figure(cube.rms_units, 2), figure(kCubeUnits, 2),
                figure(cube.side_units, 2));
  e.seen = "The worst corner is off by " + figure(cube.worst_units, 2) +
           " units; the dissertation’s corners all lie within " + figure(kWorstCornerUnits, 0) + ".";
  std::string corners;
  for (std::size_t i = 0; i < cube.corners.size(); ++i) {
    const CubeTable::Corner& c = cube.corners[i];
    std::vector<std::string> cells;
    for (const pipeline::Vec3d* p : {&c.truth, &c.found})
      for (const double v : {p->x, p->y, p->z}) cells.push_back(figure(v, 2));
    cells.push_back(figure(c.off_units, 2));
    corners += row("corner " + std::to_string(i + 1), cells);
  }
  e.wide = table({"Ours, units", "true x", "y", "z", "found x", "y", "z", "off by"}, corners);
  return section(e);
}

std::string scores(const std::vector<const Run*>& runs, const Comparison& c) {
  const bool truth = c.pairs.front().truth.has_value();
  std::string rows;
  for (const Run* run : runs) {
    std::vector<std::string> cells{"–", "–", "–"};
    if (run->score)
      cells = {percent_of(run->score->bad_limit), percent_of(run->score->bad_given),
               percent_of(run->score->density)};
    if (!truth)
      cells = {percent_of(run->matches.accepted, run->matches.keypoints),
               run->left_right ? percent_of(run->left_right->within_1px) : "–"};
    rows += row(sections::name_of(c, *run), cells);
  }
  return truth ? table({"", "bad", "bad of the given", "density"}, rows)
               : table({"", "matched", "left and right agree<small>within 1 px</small>"}, rows);
}

// What a figure shows where a set failed in it.
std::string failures(const Figure& f) {
  std::string out;
  for (const Run* run : f.runs)
    if (!run->failure.empty())
      out += "<p class=\"failed\">" + escaped(sections::name_of(f.of, *run) + ": " + run->failure) + "</p>\n";
  return out;
}

const char* const kNoTruth = " No truth is known of this pair: nothing says which of them are right.";

Result<std::string> figure_6(const Figure& f) {
  Entry e{"figure-6", "Figure 6: " + f.title, {}, {}, {}, {}};
  e.theirs =
      "<p>Disparity maps by sums of squared differences (SSD) and by zero-mean normalised "
      "cross-correlation (ZMNCC). Numbers are not recorded.</p>\n";
  e.ours = scores(f.runs, f.of) + failures(f);
  for (const Run* run : f.runs) {
    e.seen += (e.seen.empty() ? (run->score ? "Bad: " : "Matched: ") : ", ") + sections::name_of(f.of, *run) +
              " " +
              (run->score ? percent_of(run->score->bad_limit)
                          : percent_of(run->matches.accepted, run->matches.keypoints));
    if (run->map.values.empty()) continue;  // it failed before it matched
    RELIEVO_TRY_ASSIGN(const std::string maps, sections::map_row(f.of, *run, sections::name_of(f.of, *run)));
    e.wide += maps;
  }
  e.seen += f.runs.front()->score ? "." : std::string(".") + kNoTruth;
  RELIEVO_TRY_ASSIGN(const std::string ground, sections::ground(f.of, 0));
  e.wide.insert(0, ground);
  return section(e);
}

// Figures 7 to 12: one constraint more than in the figure before.
Result<std::string> rule_figure(const Figure& f, const Run& before) {
  const Run& run = *f.runs.front();
  const std::string number = std::to_string(f.number);
  Entry e{"figure-" + number, "Figure " + number + ": " + f.title, {}, {}, {}, {}};
  e.theirs = "<p>The effect of the constraint on the disparity map. Numbers are not recorded.</p>\n";
  e.ours = failures(f);
  if (run.matches.rules.empty()) {
    e.seen = "Nothing was matched: there is nothing to take away.";
    return section(e);
  }
  const RuleFigures& rule = run.matches.rules.back();
  const std::size_t had = run.matches.accepted + rule.rejected;
  std::string rows =
      row("matches before",
          {std::to_string(had), percent_of(before.matches.accepted_bad, before.matches.accepted_judged)}) +
      row("taken away", {std::to_string(rule.rejected), percent_of(rule.bad, rule.judged)}) +
      row("left", {std::to_string(run.matches.accepted),
                   percent_of(run.matches.accepted_bad, run.matches.accepted_judged)});
  e.ours += table({"", "matches", "truly bad"}, rows);
  e.seen = "The constraint takes away " + percent_of(rule.rejected, had) + " of the matches";
  if (rule.judged > 0)
    e.seen += "; of these " + percent_of(rule.bad, rule.judged) + " are truly bad, of all before " +
              percent_of(before.matches.accepted_bad, before.matches.accepted_judged) + ", of what is left " +
              percent_of(run.matches.accepted_bad, run.matches.accepted_judged) + ".";
  else e.seen += run.score ? "." : std::string(".") + kNoTruth;
  RELIEVO_TRY_ASSIGN(e.wide, sections::map_row(f.of, run, sections::name_of(f.of, run)));
  return section(e);
}

Result<std::string> figure_17(const Figure& f) {
  Entry e{"figure-17", "Figure 17: " + f.title, {}, {}, {}, {}};
  e.theirs =
      "<p>A face from two pictures without any help by hand. Numbers are not recorded; its matching failed on "
      "real faces.</p>\n";
  std::string rows, seen;
  std::size_t models = 0;
  for (const Run* run : f.runs) {
    const auto mm = [run](double value, int decimals) { return run->model ? figure(value, decimals) : "–"; };
    const measure::Measurement m = run->model.value_or(measure::Measurement{});
    rows +=
        row(sections::name_of(f.of, *run), {mm(m.interior_median_mm, 3), mm(m.accuracy_p95_mm, 2),
                                            run->model ? percent_of(m.complete_half_mm) : "–",
                                            run->surface ? std::to_string(run->surface->triangles) : "–"});
    models += run->surface ? 1 : 0;
    if (run->model)
      seen += (seen.empty() ? "" : "; ") + sections::name_of(f.of, *run) + " " +
              figure(m.interior_median_mm, 3) + " mm, " + percent_of(m.complete_half_mm);
  }
  e.ours = table({"", "median<small>error, mm</small>", "95 % within<small>mm</small>",
                  "complete<small>within 0.5 mm</small>", "triangles"},
                 rows) +
           failures(f);
  e.seen = std::to_string(models) + " of " + std::to_string(f.runs.size()) + " chains give a face. ";
  e.seen += seen.empty() ? "No truth is known of this person: compare the surfaces."
                         : "Median error, and share of the face within 0.5 mm: " + seen + ".";
  e.wide =
      "<p class=\"note\">2004: histogram-match, ZMNCC, all six constraints, linear least squares, Delaunay, "
      "one picture as texture; on a lattice, and at two selectors’ places. Relievo: its defaults. Person: " +
      escaped(f.of.pairs.front().name) + ".</p>\n" + sections::figures(f.of, f.runs) +
      sections::surfaces(f.of, f.runs);
  return section(e);
}

std::string reading(const Dissertation& d) {
  return "<section class=\"reading\">\n<h2>How to read this</h2>\n<p>Left what is recorded of D. Bardsley, "
         "<em>A Correlation Based Stereo Vision System for Face Recognition Applications</em> (Nottingham, 2004): "
         "the figures of tables 1 and 2; that figures 6 to 12 show disparities by SSD and ZMNCC and what the "
         "constraints do to them; that figure 17 is the fully automatic face. Its pictures, its page numbers, and "
         "which figure from 7 to 12 shows which constraint are not recorded: the constraints follow its order here, "
         "one more in each figure. Lay its pages beside this one. Right the same by this program.</p>\n<p>Pair of figures 6 to 12: " +
         escaped(d.rules.pairs.front().name) + "; of figure 17: " + escaped(d.face.pairs.front().name) +
         ". A pixel is bad where its disparity is off by more than " +
         pipeline::report::number(d.rules.limit_px, 2) +
         " px, or where there is none though the truth is known; a match, where it is off by more.</p>\n</section>\n";
}

}  // namespace

Result<std::string> dissertation_html(const Dissertation& d, const std::string& product,
                                      const std::string& made_at) {
  std::string body = pipeline::report::heading(
      product, kTitle, {escaped(made_at), "tables 1 and 2", "figures 6 to 12 and 17"});
  body += reading(d) + table_1(d.rig) + table_2(d.cube);
  for (const Figure& f : figures_of(d)) {
    if (f.number == 17)
      body += "<section>\n<h2>Figures 6 to 12 in one table</h2>\n" +
              sections::figures(d.rules, sections::runs_of(d.rules, 0)) + "</section>\n";
    RELIEVO_TRY_ASSIGN(const std::string one, f.number == 6 ? figure_6(f)
                                              : f.number == 17
                                                  ? figure_17(f)
                                                  : rule_figure(f, d.rules.runs[f.runs.front()->set - 1]));
    body += one;
  }
  return pipeline::report::page(kTitle, std::string(sections::kStyle) + std::string(kStyle),
                                body + sections::settings(d.rules, "The sets of figures 6 to 12") +
                                    sections::settings(d.face, "The sets of figure 17"));
}

}  // namespace relievo::firmware::compare
