// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/set_run.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <utility>

#include "firmware/base/boot_memory.h"
#include "firmware/measure/comparison.h"
#include "firmware/measure/measurement.h"
#include "firmware/work/stage_drawing.h"
#include "hal/base/result.h"
#include "hal/picture_file.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware::compare {
namespace {

struct RunOrder {
  const ComparedPair& pair;
  const NamedSet& set;
  const RunOptions& options;
};

// "aloeL" of aloeL.jpg, but "d1" of d1/left.png; none twice.
std::string name_of(const Path& left, const std::vector<ComparedPair>& others) {
  const Path folder = std::filesystem::absolute(left).lexically_normal().parent_path().filename();
  const std::string name = (left.stem() == "left" && !folder.empty() ? folder : left.stem()).string();
  std::string free = name;
  const auto taken = [&](const ComparedPair& pair) { return pair.name == free; };
  for (int i = 2; std::ranges::any_of(others, taken); ++i) free = name + " " + std::to_string(i);
  return free;
}

Result<void> read_truth(const Path& truth, const CompareArgs& args, ComparedPair& pair) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(truth, ignored)) {
    if (!args.rectified && std::filesystem::exists(truth, ignored))
      return invalid(
                 "is a disparity map, which fits rectified pictures: give --rectified, or a folder of 'relievo simulate face --truth'")
          .at(truth.string());
    RELIEVO_TRY_ASSIGN(pair.disparities, read_disparity_truth(truth, args.truth_scale));
    const DisparityMap& map = pair.disparities->map;
    if (map.width_px == pair.pictures.left.width_px && map.height_px == pair.pictures.left.height_px)
      return {};
    return invalid("has another size than the left picture: give the truth of this pair").at(truth.string());
  }
  if (args.rectified)
    return invalid("is a folder of the simulated rig, whose pictures are not rectified: give --calibration")
        .at(truth.string());
  RELIEVO_TRY_ASSIGN(pair.view, measure::TruthView::read(truth));
  RELIEVO_TRY_ASSIGN(pair.head, measure::read_true_surface(truth / "head.ply"));
  return {};
}

// A line of /proc/self/status: "VmHWM:	  123456 kB".
std::size_t status_bytes(std::string_view key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10) * 1024;
  return 0;
}

// The high-water mark falls to what is held now (proc(5)).
bool restart_peak() {
  std::ofstream file("/proc/self/clear_refs");
  return static_cast<bool>(file << "5" << std::flush);
}

// PeakMemory: the most memory the process held resident since this was made, above what it held then: arenas
// and every library's heap together. Linux counts it; elsewhere, or where /proc may not be written, 0.
// Thread: any, one at a time.
class PeakMemory {
 public:
  std::size_t above_bytes() const {
    const std::size_t peak = status_bytes("VmHWM:");
    return before_ == 0 || peak < before_ ? 0 : peak - before_;
  }

 private:
  const std::size_t before_ = restart_peak() ? status_bytes("VmRSS:") : 0;
};

// What a model's surface looks like, in clay: from in front and from the side, each 230 mm across.
// Times are left to the caller. Errors: those of the picture encoder. Thread: any.

constexpr int kSidePx = 420;
constexpr double kAcrossMm = 230, kTurnedDeg = 50;

Result<std::vector<std::byte>> head_picture(const pipeline::FaceModel& model, double turned_deg) {
  std::vector<std::uint8_t> rgb(std::size_t{3} * kSidePx * kSidePx);
  StageCanvas canvas(rgb.data(), kSidePx);
  draw_head(model.mesh, model.head_from_camera, turned_deg, kAcrossMm, canvas);
  return hal::encode_png(
      {reinterpret_cast<const std::byte*>(rgb.data()), kSidePx, kSidePx, 3 * kSidePx, PixelFormat::Rgb8});
}

Result<SurfaceLook> surface_look(const pipeline::FaceModel& model) {
  SurfaceLook look;
  look.vertices = model.mesh.vertices_mm.size();
  look.measured = std::size_t(std::ranges::count(model.mesh.measured, 1));
  look.triangles = model.mesh.triangles.size();
  RELIEVO_TRY_ASSIGN(look.front, head_picture(model, 0));
  RELIEVO_TRY_ASSIGN(look.side, head_picture(model, kTurnedDeg));
  return look;
}

// Runs the steps, each timed and with a scratch arena of its own.
class StepRunner {
 public:
  StepRunner(ThreadPool& pool, JobControl& control, Run& run)
      : memory_(0, budget::kLargestPlan.products, budget::kLargestPlan.scratch),
        output_(memory_.output()),
        pool_(pool),
        control_(control),
        run_(run) {}

  template <typename Step>
  auto step(const char* name, Step&& work) {
    Arena scratch(memory_.scratch());
    pipeline::StageContext context{output_, scratch, pool_, control_.progress, control_.cancelled};
    const auto begin = std::chrono::steady_clock::now();
    auto result = pipeline::run_stage(context, std::forward<Step>(work));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    scratch_peak_ = std::max(scratch_peak_, scratch.high_water());
    run_.stages.push_back({name, took.count(), output_.used() + scratch.high_water()});
    return result;
  }
  // What is looked at beside the reconstruction: neither its time nor its memory counts.
  template <typename Step>
  auto beside(Step&& work) {
    BootMemory memory(0, budget::kLargestPlan.products, budget::kLargestPlan.scratch);
    Arena output(memory.output());
    Arena scratch(memory.scratch());
    pipeline::StageContext context{output, scratch, pool_, control_.progress, control_.cancelled};
    return pipeline::run_stage(context, std::forward<Step>(work));
  }
  std::size_t touched_bytes() const { return output_.high_water() + scratch_peak_; }

 private:
  BootMemory memory_;
  Arena output_;
  ThreadPool& pool_;
  JobControl& control_;
  Run& run_;
  std::size_t scratch_peak_ = 0;
};

// What the steps make, in their order.
struct Made {
  std::optional<pipeline::RectifiedPair> pair;
  std::optional<pipeline::Keypoints> keypoints;
  std::optional<pipeline::MatchSet> matches;
  std::optional<pipeline::FaceModel> model;
};

Result<void> rectify(const RunOrder& order, const std::optional<pipeline::Pipeline>& pipeline,
                     StepRunner& runner, Made& made) {
  RELIEVO_TRY_ASSIGN(
      made.pair, runner.step("rectify", [&](pipeline::StageContext& c) -> Result<pipeline::RectifiedPair> {
        if (pipeline) return pipeline->rectify(order.pair.pictures.frame(), c);
        RELIEVO_TRY_ASSIGN(pipeline::RectifiedPair pair,
                           pipeline::take_rectified(order.pair.pictures.frame(), order.pair.range, c));
        if (order.options.whole_view) return pair;
        RELIEVO_TRY_ASSIGN(auto finder, pipeline::FaceFinder::open());
        RELIEVO_TRY_ASSIGN(const pipeline::FaceBox face, pipeline::find_face(finder, pair, c));
        RELIEVO_TRY(pipeline::mark_face_region(pair, face, c));
        return pair;
      }));
  return {};
}

// Step by step what Pipeline::match() does, so that each can be timed and its product looked at.
Result<void> match(const NamedSet& set, StepRunner& runner, Made& made) {
  RELIEVO_TRY_ASSIGN(const auto use, pipeline::make_algorithms(set.set));
  if (use.preprocessor) {
    RELIEVO_TRY(runner.step("preprocess",
                            [&](pipeline::StageContext& c) { return use.preprocessor(*made.pair, c); }));
  }
  const pipeline::RectifiedPair& pair = *made.pair;
  RELIEVO_TRY_ASSIGN(made.keypoints,
                     runner.step("select", [&](pipeline::StageContext& c) { return use.selector(pair, c); }));
  RELIEVO_TRY_ASSIGN(made.matches, runner.step("match", [&](pipeline::StageContext& c) {
    return use.matcher(pair, *made.keypoints, c);
  }));
  return runner.step("judge", [&](pipeline::StageContext& c) -> Result<void> {
    std::uint16_t bit = 1;
    for (const auto& constraint : use.constraints) {
      constraint(pair, made.matches->matches, made.matches->lattice_step_px, bit, c);
      bit = std::uint16_t(bit << 1U);
    }
    return {};
  });
}

Result<void> build_model(const RunOrder& order, const pipeline::Pipeline& pipeline, StepRunner& runner,
                         Made& made, Run& run) {
  using pipeline::StageContext;
  const pipeline::RectifiedPair& pair = *made.pair;
  RELIEVO_TRY_ASSIGN(const auto cloud, runner.step("reconstruct", [&](StageContext& c) {
    return pipeline.reconstruct(pair, *made.matches, c);
  }));
  RELIEVO_TRY_ASSIGN(auto mesh,
                     runner.step("mesh", [&](StageContext& c) { return pipeline.mesh(cloud, pair, c); }));
  RELIEVO_TRY_ASSIGN(
      auto texture, runner.step("texture", [&](StageContext& c) { return pipeline.texture(mesh, pair, c); }));
  RELIEVO_TRY_ASSIGN(made.model, runner.step("assemble", [&](StageContext& c) {
    return pipeline.assemble(std::move(mesh), std::move(texture), pair, c);
  }));
  if (order.pair.view) run.model = measure::measure(made.model->mesh, *order.pair.view, *order.pair.head);
  return {};
}

void note_facts(const RunOrder& order, const pipeline::RectifiedPair& pair, PairFacts& facts) {
  if (facts.width_px != 0) return;
  facts.width_px = pair.width_px;
  facts.height_px = pair.height_px;
  facts.least_px = pair.disparity_px(pair.far_mm);
  facts.most_px = pair.disparity_px(pair.near_mm);
  facts.rectified = !order.pair.calibration;
  facts.grey.resize(pair.left.grey.size());
  std::ranges::transform(pair.left.grey, facts.grey.begin(),
                         [](float g) { return std::uint8_t(std::clamp(std::lround(g), 0L, 255L)); });
  if (order.pair.disparities) facts.truth = order.pair.disparities;
  else if (order.pair.view) facts.truth = truth_of_view(*order.pair.view, pair);
}

Result<void> all_steps(const RunOrder& order, StepRunner& runner, PairFacts& facts, Made& made, Run& run) {
  std::optional<pipeline::Pipeline> pipeline;  // without a rig there is nothing to build
  if (order.pair.calibration) {
    const auto region = order.options.whole_view ? pipeline::Region::All : pipeline::Region::Face;
    RELIEVO_TRY_ASSIGN(pipeline,
                       pipeline::Pipeline::make(order.set.set, *order.pair.calibration, {}, region));
  }
  RELIEVO_TRY(rectify(order, pipeline, runner, made));
  note_facts(order, *made.pair, facts);
  const std::size_t before = run.stages.size();
  RELIEVO_TRY(match(order.set, runner, made));
  for (std::size_t i = before; i < run.stages.size(); ++i) run.match_ms += run.stages[i].ms;
  run.map = disparity_map(*made.matches, made.pair->width_px, made.pair->height_px);
  run.matches = figures_of(order.set, *made.keypoints, *made.matches, facts.truth, order.options.limit_px);
  run.rejected_by = rejected_map(*made.matches, made.pair->width_px, made.pair->height_px);
  if (facts.truth) run.score = score(run.map, *facts.truth, order.options.limit_px);
  if (!pipeline || !order.options.models) return {};
  const auto built = build_model(order, *pipeline, runner, made, run);
  // A handful of places is compared all the same; that they make no face is no failure of theirs.
  const Errc code = built ? Errc::Cancelled : built.error().code;
  const bool few = made.matches->lattice_step_px == 0 && run.stages.back().name != "assemble" &&
                   (code == Errc::PoorGeometry || code == Errc::TooFewMatches || code == Errc::NoFace);
  if (!few) return built;
  run.no_surface = "no surface, not judged to be a face: " + std::to_string(run.matches.accepted) +
                   " accepted matches are too few, or too far apart";
  return {};
}

// Of places that are no lattice, which is no choice.
Result<void> look_at_selector(const RunOrder& order, StepRunner& runner, const pipeline::RectifiedPair& pair,
                              const PairFacts& facts, const Made& made, Run& run) {
  RELIEVO_TRY_ASSIGN(const auto use, pipeline::make_algorithms(order.set.set));
  const DisparityMap& region = facts.truth ? facts.truth->map : run.map;
  return runner.beside([&](pipeline::StageContext& c) -> Result<void> {
    RELIEVO_TRY_ASSIGN(const auto right, select_in_right(use.selector, pair, region, c));
    run.selector = selector_figures(pair, *made.keypoints, right, *made.matches, facts.truth);
    return {};
  });
}

// What says how good the matches are without knowing what is true.
Result<void> look_at_matches(const RunOrder& order, StepRunner& runner, const PairFacts& facts,
                             const Made& made, Run& run) {
  if (!made.matches) return {};
  if (made.matches->epipolar_shift.measured()) run.epipolar_px = made.matches->epipolar_shift.residual_px;
  const pipeline::RectifiedPair& pair = *made.pair;
  std::optional<DisparityMap> model;
  if (made.model) {
    RELIEVO_TRY_ASSIGN(run.surface, surface_look(*made.model));
    for (const StageCost& stage : run.stages)
      if (stage.name == "mesh") run.surface->mesh_ms = stage.ms;
    model = model_view(*made.pair, made.model->mesh);
    RELIEVO_TRY(runner.beside([&](pipeline::StageContext& c) -> Result<void> {
      run.photo = photo_figures(*made.pair, *model, c);
      return {};
    }));
  }
  if (made.keypoints->lattice_step_px == 0) return look_at_selector(order, runner, pair, facts, made, run);
  return runner.beside([&](pipeline::StageContext& c) -> Result<void> {
    RELIEVO_TRY_ASSIGN(run.left_right, left_right_figures(pair, order.set.set, run.map, model, c));
    return {};
  });
}

std::string words_of(const Run& run, const Error& error) {
  const std::string where(error.where());
  return (run.stages.empty() ? "" : run.stages.back().name + ": ") + (where.empty() ? "" : where + ": ") +
         std::string(error.what.view());
}

// What the algorithms say against it becomes `run.failure`; `facts` is filled in by the first set that
// rectifies. Errors: Cancelled; those of `keep_model`.
Result<void> run_set(const RunOrder& order, ThreadPool& pool, JobControl& control, PairFacts& facts,
                     Run& run) {
  const PeakMemory peak;
  StepRunner runner(pool, control, run);
  Made made;
  Result<void> done = all_steps(order, runner, facts, made, run);
  run.arena_peak_bytes = runner.touched_bytes();
  const std::size_t above = peak.above_bytes();
  run.heap_peak_bytes = above > run.arena_peak_bytes ? above - run.arena_peak_bytes : 0;
  // That a model cannot be kept is no failure of the algorithms: it ends the job.
  if (done && made.model && order.options.keep_model) RELIEVO_TRY(order.options.keep_model(*made.model));
  if (!done) run.failure = words_of(run, done.error());
  if (done || done.error().code != Errc::Cancelled) done = look_at_matches(order, runner, facts, made, run);
  return done || done.error().code != Errc::Cancelled ? Result<void>() : done;
}

}  // namespace

Result<std::vector<ComparedPair>> read_pairs(const CompareArgs& args) {
  const std::size_t count = args.pictures.size() / 2;
  std::vector<ComparedPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const Path& left = args.pictures[2 * i];
    ComparedPair pair;
    pair.name = name_of(left, pairs);
    RELIEVO_TRY_ASSIGN(pair.pictures, read_pair(left, args.pictures[2 * i + 1]));
    const auto of_pair = [i](const std::vector<Path>& given) {
      return given.size() == 1 ? given[0] : given[i];
    };
    if (args.rectified) {
      pair.range = {args.least_disparity_px, args.most_disparity_px};
    } else {
      RELIEVO_TRY_ASSIGN(pair.calibration,
                         read_calibration_for(pair.pictures, of_pair(args.calibrations), left));
    }
    if (!args.truths.empty()) RELIEVO_TRY(read_truth(of_pair(args.truths), args, pair));
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

Result<Comparison> compare_sets(std::vector<ComparedPair> pairs, std::vector<NamedSet> sets,
                                const RunOptions& options, std::atomic<std::size_t>& at,
                                JobControl& control) {
  Comparison c;
  c.sets = std::move(sets);
  c.limit_px = options.limit_px;
  ThreadPool pool(pool_size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    PairFacts& facts = c.pairs.emplace_back();
    facts.name = pairs[p].name;
    for (std::size_t s = 0; s < c.sets.size(); ++s) {
      at.store(c.runs.size(), std::memory_order_relaxed);
      Run& run = c.runs.emplace_back();
      run.set = s;
      run.pair = p;
      RELIEVO_TRY(run_set({pairs[p], c.sets[s], options}, pool, control, facts, run));
    }
    pairs[p] = {};  // what is looked at again lies in the facts
  }
  return c;
}

}  // namespace relievo::firmware::compare
