// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/base/version.h"
#include "firmware/compare/page/compare_page.h"

namespace relievo::firmware::compare {
namespace {

using Json = nlohmann::ordered_json;

Json score_json(const DisparityScore& s) {
  return {{"judged_px", s.judged},
          {"given_px", s.given},
          {"density", s.density},
          {"bad", s.bad_limit},
          {"bad_0.5px", s.bad_half},
          {"bad_1px", s.bad_1},
          {"bad_2px", s.bad_2},
          {"bad_4px", s.bad_4},
          {"bad_of_given", s.bad_given},
          {"seen_by_both_px", s.seen},
          {"bad_of_seen_by_both", s.bad_seen},
          {"mean_px", s.mean_px},
          {"rms_px", s.rms_px},
          {"median_px", s.median_px},
          {"p95_px", s.p95_px},
          {"bias_px", s.bias_px},
          {"histogram",
           {{"from_px", -ErrorHistogram::kReachPx},
            {"to_px", ErrorHistogram::kReachPx},
            {"counts", s.histogram.counts}}}};
}

Json model_json(const measure::Measurement& m) {
  return {{"accuracy_median_mm", m.accuracy_median_mm},
          {"accuracy_p95_mm", m.accuracy_p95_mm},
          {"interior_median_mm", m.interior_median_mm},
          {"interior_p95_mm", m.interior_p95_mm},
          {"complete_0.25mm", m.complete_quarter_mm},
          {"complete_0.5mm", m.complete_half_mm},
          {"complete_1mm", m.complete_1mm},
          {"outliers_3mm", m.outliers_3mm},
          {"measured_vertices_in_face", m.measured_vertices},
          {"within_sigma", m.within_sigma},
          {"within_1.96_sigma", m.within_196_sigma},
          {"moved_mm", m.moved_mm},
          {"turned_deg", m.turned_deg}};
}

Json matches_json(const MatchFigures& f) {
  Json rules = Json::array();
  for (const RuleFigures& rule : f.rules)
    rules.push_back(
        {{"name", rule.name}, {"rejected", rule.rejected}, {"judged", rule.judged}, {"truly_bad", rule.bad}});
  return {{"keypoints", f.keypoints},
          {"matches", f.matches},
          {"accepted", f.accepted},
          {"judged", f.judged},
          {"bad", f.bad},
          {"accepted_judged", f.accepted_judged},
          {"accepted_bad", f.accepted_bad},
          {"constraints", rules}};
}

Json selector_json(const SelectorFigures& f) {
  Json json{{"places_left", f.left}, {"places_right", f.right},    {"repeatability", nullptr},
            {"asked", f.asked},      {"match_rate", f.match_rate}, {"spread", f.spread}};
  if (f.repeatability) json["repeatability"] = *f.repeatability;
  return json;
}

Json left_right_json(const LeftRightFigures& f) {
  return {{"asked_px", f.asked},
          {"answered_px", f.answered},
          {"median_px", f.median_px},
          {"p95_px", f.p95_px},
          {"within_1px", f.within_1px}};
}

Json run_json(const Comparison& c, const Run& run) {
  Json stages = Json::array();
  for (const StageCost& stage : run.stages)
    stages.push_back({{"name", stage.name}, {"ms", stage.ms}, {"arena_peak_bytes", stage.arena_peak_bytes}});
  Json json{{"pair", c.pairs[run.pair].name},
            {"set", c.sets[run.set].name},
            {"failure", nullptr},
            {"stages", stages},
            {"match_ms", run.match_ms},
            {"arena_peak_bytes", run.arena_peak_bytes},
            {"heap_peak_bytes", run.heap_peak_bytes},
            {"matches", matches_json(run.matches)}};
  if (!run.failure.empty()) json["failure"] = run.failure;
  if (!run.no_surface.empty()) json["no_surface"] = run.no_surface;
  if (run.left_right) json["left_right"] = left_right_json(*run.left_right);
  if (run.photo)
    json["photo_consistency"] = {
        {"windows", run.photo->asked}, {"median", run.photo->median}, {"p5", run.photo->p5}};
  if (run.epipolar_px) json["epipolar_residual_px"] = *run.epipolar_px;
  if (run.selector) json["selector"] = selector_json(*run.selector);
  if (run.score) json["disparity"] = score_json(*run.score);
  if (run.surface)
    json["surface"] = {{"vertices", run.surface->vertices},
                       {"measured_vertices", run.surface->measured},
                       {"triangles", run.surface->triangles},
                       {"mesh_ms", run.surface->mesh_ms}};
  if (run.model) json["model"] = model_json(*run.model);
  return json;
}

// Every two sets on the pixels that both give.
Json shared_json(const Comparison& c) {
  Json all = Json::array();
  for (std::size_t i = 0; i < c.runs.size(); ++i)
    for (std::size_t k = i + 1; k < c.runs.size(); ++k) {
      const Run& one = c.runs[i];
      const Run& other = c.runs[k];
      if (one.pair != other.pair || !one.score || !other.score) continue;
      const SharedScore s = score_shared(one.map, other.map, *c.pairs[one.pair].truth, c.limit_px);
      all.push_back({{"pair", c.pairs[one.pair].name},
                     {"one", c.sets[one.set].name},
                     {"other", c.sets[other.set].name},
                     {"shared_px", s.shared},
                     {"bad_one", s.bad_one},
                     {"bad_other", s.bad_other},
                     {"median_one_px", s.median_one_px},
                     {"median_other_px", s.median_other_px}});
    }
  return all;
}

Json sets_json(const Comparison& c) {
  Json sets = Json::array();
  for (const NamedSet& set : c.sets)
    sets.push_back({{"name", set.name}, {"algorithms", choices_in(set.set.to_text())}});
  return sets;
}

Json pair_json(const PairFacts& pair) {
  return {{"name", pair.name},
          {"width_px", pair.width_px},
          {"height_px", pair.height_px},
          {"rectified", pair.rectified},
          {"disparities_px", {pair.least_px, pair.most_px}},
          {"truth", pair.truth.has_value()}};
}

// A name may hold bytes that are no UTF-8: they are replaced, never thrown about.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json cube_json(const CubeTable& cube) {
  Json corners = Json::array();
  const auto three = [](const pipeline::Vec3d& p) { return Json{p.x, p.y, p.z}; };
  for (const CubeTable::Corner& corner : cube.corners)
    corners.push_back({{"true_units", three(corner.truth)},
                       {"found_units", three(corner.found)},
                       {"off_units", corner.off_units}});
  return {{"worst_units", cube.worst_units},
          {"rms_units", cube.rms_units},
          {"side_units", cube.side_units},
          {"corners", corners}};
}

}  // namespace

std::string dissertation_json(const Dissertation& d, const std::string& made_at) {
  const RigTable& rig = d.rig;
  Json json{{"version", kVersion},
            {"made_at", made_at},
            {"bad_beyond_px", d.rules.limit_px},
            {"table_1",
             {{"dissertation",
               {{"true_baseline_units", recorded::kBaselineUnits},
                {"baseline_units", recorded::kFoundBaselineUnits},
                {"focal_px", recorded::kFoundFocalPx}}},
              {"relievo",
               {{"true_baseline_units", recorded::kBaselineUnits},
                {"baseline_units", rig.baseline_units},
                {"true_focal_px", rig.true_focal_px},
                {"focal_px", rig.focal_px},
                {"pair_rms_px", rig.pair_rms_px}}}}},
            {"table_2",
             {{"dissertation", {{"worst_units_below", recorded::kWorstCornerUnits}}},
              {"relievo", cube_json(d.cube)}}}};
  for (const Figure& figure : figures_of(d)) {
    Json runs = Json::array();
    for (const Run* run : figure.runs) runs.push_back(run_json(figure.of, *run));
    json["figure_" + std::to_string(figure.number)] = {{"pair", pair_json(figure.of.pairs.front())},
                                                       {"runs", runs}};
  }
  json["sets_of_figures_6_to_12"] = sets_json(d.rules);
  json["sets_of_figure_17"] = sets_json(d.face);
  return text_of(json);
}

std::string comparison_json(const Comparison& c, const std::string& made_at) {
  Json pairs = Json::array();
  for (const PairFacts& pair : c.pairs) pairs.push_back(pair_json(pair));
  Json runs = Json::array();
  for (const Run& run : c.runs) runs.push_back(run_json(c, run));
  return text_of({{"version", kVersion},
                  {"made_at", made_at},
                  {"bad_beyond_px", c.limit_px},
                  {"sets", sets_json(c)},
                  {"pairs", pairs},
                  {"runs", runs},
                  {"shared_pixels", shared_json(c)}});
}

}  // namespace relievo::firmware::compare
