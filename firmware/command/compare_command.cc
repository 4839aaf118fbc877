// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>

#include "firmware/base/output_folder.h"
#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/command/commands.h"
#include "firmware/compare/set_run.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/measure/comparison.h"
#include "hal/base/whole_file.h"
#include "hal/base/words.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {
namespace {

using compare::Comparison;
using compare::Run;

const std::string kProduct = "Relievo " + std::string(kVersion);

std::string now_of(const Services& services) { return text_of(stored_time(services.clock.wall_now())); }

Result<void> write_result(const OutputFolder& folder, const Path& place, const Result<std::string>& page,
                          const std::string& json) {
  if (!page) return page.error();
  RELIEVO_TRY(write_text(folder.path() / "index.html", *page, place));
  return write_text(folder.path() / "compare.json", json, place);
}

// A line a run, for a terminal.
std::string summary_of(const Comparison& c, const Run& run) {
  const std::string name = c.pairs[run.pair].name + ", " + c.sets[run.set].name + ": ";
  if (!run.failure.empty() && !run.score) return name + "failed: " + run.failure;
  std::string figures;
  if (run.model)
    figures = printed(
        "interior median %.4f mm, accuracy p95 %.4f mm, complete at 0.5 mm %.4f, outliers %.5f, match %.0f ms",
        run.model->interior_median_mm, run.model->accuracy_p95_mm, run.model->complete_half_mm,
        run.model->outliers_3mm, run.match_ms);
  else if (run.score)
    figures = printed(
        "bad %.2f %% (of given %.2f %%, of seen by both %.2f %%), density %.2f %%, rms %.2f px, match %.0f ms",
        100 * run.score->bad_limit, 100 * run.score->bad_given, 100 * run.score->bad_seen,
        100 * run.score->density, run.score->rms_px, run.match_ms);
  else
    figures = printed("%zu of %zu matched, match %.0f ms", run.matches.accepted, run.matches.keypoints,
                      run.match_ms);
  if (run.surface) figures += printed(", mesh %.0f ms", run.surface->mesh_ms);
  return name + figures + (run.failure.empty() ? "" : "; failed: " + run.failure) +
         (run.no_surface.empty() ? "" : "; " + run.no_surface);
}

// "2-1_d2_refined.pfm": numbers of pair and set, and their names as far as files may be called so.
std::string map_name(const Comparison& c, const Run& run) {
  std::string name = std::to_string(run.pair + 1) + "-" + std::to_string(run.set + 1) + "_" +
                     c.pairs[run.pair].name + "_" + c.sets[run.set].name;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char ch) { return std::isalnum(ch) == 0 && ch != '-' && ch != '_'; }, '_');
  return name.substr(0, 100) + ".pfm";
}

Result<void> write_maps(const Comparison& c, const OutputFolder& folder, const Path& place) {
  for (const Run& run : c.runs) {
    if (run.map.values.empty()) continue;
    RELIEVO_TRY(
        write_whole_file(folder.path() / map_name(c, run), compare::pfm_of(run.map)).at(place.string()));
  }
  return {};
}

Result<void> run_dissertation(const CompareArgs& args, Services& services) {
  compare::DissertationOrder order;
  RELIEVO_TRY_ASSIGN(order.rule_sets, compare::make_sets(args.algorithms, compare::dissertation_rule_sets()));
  RELIEVO_TRY_ASSIGN(order.face_sets, compare::make_sets(args.algorithms, compare::dissertation_face_sets()));
  RELIEVO_TRY_ASSIGN(auto pairs, compare::read_pairs(args));
  if (!pairs.empty()) order.pair = std::move(pairs.front());
  order.whole_view = args.algorithms.whole_view;
  order.limit_px = args.limit_px;
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  order.work = folder.path() / "simulated";
  services.console.say("tables 1 and 2, figures 6 to 12 and 17 of the dissertation: a minute or two");
  compare::Dissertation made;
  std::atomic<const char*> at{"tables 1 and 2"};
  FunctionJob job([&](JobControl& control) -> Result<void> {
    RELIEVO_TRY_ASSIGN(made, compare::do_again(order, services.simulate, at, control));
    return {};
  });
  RELIEVO_TRY(run_watched(job, services.console, [&at] { return at.load(); }));
  std::error_code ignored;
  std::filesystem::remove_all(folder.path() / "simulated", ignored);

  RELIEVO_TRY(write_result(folder, args.output, compare::dissertation_html(made, kProduct, now_of(services)),
                           compare::dissertation_json(made, now_of(services))));
  RELIEVO_TRY(folder.commit());
  services.console.say(printed(
      "table 1: baseline %.3f units, the dissertation's %.3f (true %.3f)\n"
      "table 2: worst corner off by %.2f units, the dissertation's within %.0f",
      made.rig.baseline_units, compare::recorded::kFoundBaselineUnits, compare::recorded::kBaselineUnits,
      made.cube.worst_units, compare::recorded::kWorstCornerUnits));
  for (const compare::Figure& figure : compare::figures_of(made))
    for (const Run* run : figure.runs)
      services.console.say("figure " + std::to_string(figure.number) + ": " + summary_of(figure.of, *run));
  services.console.say("report and figures: " + args.output.string());
  return {};
}

}  // namespace

Result<void> run(const CompareArgs& args, Services& services) {
  interrupted();  // from here on Ctrl-C is heard: the output's folder must not be left behind
  if (args.suites == std::vector{std::string(compare::kDissertation)})
    return run_dissertation(args, services);
  RELIEVO_TRY_ASSIGN(auto sets, compare::choose_sets(args));
  RELIEVO_TRY_ASSIGN(auto pairs, compare::read_pairs(args));
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  // One set on one pair is a reconstruction that is measured: its model goes along.
  std::function<Result<void>(const pipeline::FaceModel&)> keep_model;
  if (sets.size() == 1 && pairs.size() == 1)
    keep_model = [&](const pipeline::FaceModel& model) -> Result<void> {
      RELIEVO_TRY(storage::write_model_files(model, folder.path(), storage::ExportFrame::Camera)
                      .at(args.output.string()));
      return {};
    };
  services.console.say(
      std::to_string(sets.size()) + (sets.size() == 1 ? " set on " : " sets on ") +
      std::to_string(pairs.size()) + (pairs.size() == 1 ? " pair" : " pairs") +
      (args.truths.empty() ? "; no truth is known: nothing below says how wrong a set is" : ""));
  std::vector<std::string> labels;
  for (const compare::ComparedPair& pair : pairs)
    for (const compare::NamedSet& set : sets) labels.push_back(pair.name + ", " + set.name);
  const compare::RunOptions options{args.algorithms.whole_view, args.limit_px, true, keep_model};
  Comparison comparison;
  std::atomic<std::size_t> at{0};
  FunctionJob job([&](JobControl& control) -> Result<void> {
    RELIEVO_TRY_ASSIGN(comparison,
                       compare::compare_sets(std::move(pairs), std::move(sets), options, at, control));
    return {};
  });
  RELIEVO_TRY(run_watched(job, services.console, [&]() -> std::string_view { return labels[at.load()]; }));

  RELIEVO_TRY(write_result(folder, args.output,
                           compare::comparison_html(comparison, kProduct, now_of(services)),
                           compare::comparison_json(comparison, now_of(services))));
  if (args.keep_maps) RELIEVO_TRY(write_maps(comparison, folder, args.output));
  RELIEVO_TRY(folder.commit());
  for (const Run& run : comparison.runs) services.console.say(summary_of(comparison, run));
  services.console.say("page and figures: " + args.output.string());
  return {};
}

}  // namespace relievo::firmware
