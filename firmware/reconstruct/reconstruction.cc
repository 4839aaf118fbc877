// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/reconstruct/reconstruction.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/work/jobs.h"
#include "hal/base/whole_file.h"
#include "hal/clock.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/fuse/head_pipeline.h"
#include "pipeline/match/file/match_text.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/recognition/recognition_images.h"

namespace relievo::firmware {
namespace {

constexpr std::size_t kMostByHandBytes = std::size_t{64} << 20;

// The file, and at what in it.
Error placed(const Error& error, const Path& file) {
  return error.at(file.string() + (error.where().empty() ? "" : ": " + std::string(error.where())));
}

// The words of --from.
State stage_named(std::string_view word) {
  if (word == "match") return State::Match;
  if (word == "reconstruct") return State::Reconstruct;
  if (word == "mesh") return State::Mesh;
  return word == "texture" ? State::Texture : State::Assemble;
}

Result<State> first_stage(std::string_view from, State changed) {
  if (from.empty()) return changed;
  const State named = stage_named(from);
  if (changed >= named) return named;
  return invalid("a setting changes a stage before this one: begin there, or leave --from out")
      .at("--from " + std::string(from));
}

Result<std::vector<pipeline::Match>> read_by_hand(const Path& file,
                                                  const pipeline::StereoCalibration& calibration) {
  pipeline::RectifiedPair windows(std::pmr::get_default_resource());
  RELIEVO_TRY(pipeline::lay_windows(calibration, {}, windows));
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMostByHandBytes));
  RELIEVO_TRY_ASSIGN(
      const auto matches,
      pipeline::matches_in({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string(),
                           windows, pipeline::kHandSigmaPx, std::pmr::get_default_resource()));
  return std::vector<pipeline::Match>(matches.begin(), matches.end());
}

static_assert(kMostPairs == pipeline::kMostPoses);

}  // namespace

Result<void> Reconstruction::run(const ReconstructArgs& args, Console& console) {
  if (args.pictures.size() > 2) return run_head(args, console);
  const Path &left = args.pictures[0], &calibration_file = args.calibrations[0];
  RELIEVO_TRY_ASSIGN(PicturePair pictures, read_pair(left, args.pictures[1]));
  RELIEVO_TRY_ASSIGN(making_.calibration, read_calibration_for(pictures, calibration_file, left));
  RELIEVO_TRY_ASSIGN(making_.set, choose_algorithms(args.algorithms));
  making_.whole_view = args.algorithms.whole_view;
  if (!args.by_hand.empty()) {
    RELIEVO_TRY_ASSIGN(making_.by_hand, read_by_hand(args.by_hand, making_.calibration));
  }
  RELIEVO_TRY(session_.open(""));
  session_.products().frame = pictures.frame();
  left_ = std::move(pictures.left.bytes);  // what the frame looks at stays where it is
  right_ = std::move(pictures.right.bytes);
  RELIEVO_TRY(work(State::Match, console, left, args.despite_drift));
  report_.calibration = calibration_file.string();
  return {};
}

Result<void> Reconstruction::load(const ReconstructArgs& args, Console& console) {
  const Path& document = args.load;
  const auto of_document = [&document](const Error& error) {
    return error.where().empty() ? error.at(document.string()) : error;
  };
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes,
                     read_whole_file(document, storage::kMaxDocumentBytes));
  const auto saved = storage::Document::open(bytes);
  if (!saved) return of_document(saved.error());
  RELIEVO_TRY_ASSIGN(making_, making_of(*saved));
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet wanted, choose_algorithms(args.algorithms, making_.set));
  State changed = first_change(making_.set, wanted);
  if (!args.by_hand.empty()) {
    RELIEVO_TRY_ASSIGN(making_.by_hand, read_by_hand(args.by_hand, making_.calibration));
    changed = std::min(changed, State::Reconstruct);
  }
  RELIEVO_TRY_ASSIGN(const State first, first_stage(args.from, changed));
  making_.set = wanted;
  RELIEVO_TRY(session_.open(""));
  pipeline::StereoFrame frame;
  frame.skew_ns = saved->head().skew_ns;
  for (const bool left : {true, false}) {
    auto picture = saved->picture(left);
    if (!picture) return of_document(picture.error());
    (left ? left_ : right_) = std::move(picture->bytes);
    (left ? frame.left : frame.right) = picture->view;
  }
  session_.products().frame = frame;
  const std::atomic<bool> never{false};
  pipeline::Progress progress;
  JobControl control{never, progress};
  const Result<State> left_to_do = load_products(*saved, first, session_, control);
  if (!left_to_do) return of_document(left_to_do.error());
  RELIEVO_TRY(work(*left_to_do, console, document, args.despite_drift));
  report_.calibration = document.string();
  return {};
}

// All stages in a row, or the last of them. What is done already is in the session, and its records in the
// making.
Result<void> Reconstruction::work(State first, Console& console, const Path& named, bool despite_drift) {
  first_ = first;
  making_.records.resize(std::min(making_.records.size(), std::size_t(first) - std::size_t(State::Match)));
  if (first != State::Review) {
    RELIEVO_TRY_ASSIGN(auto pipeline, pipeline::Pipeline::make(making_.set, making_.calibration, {},
                                                               making_.whole_view ? pipeline::Region::All
                                                                                  : pipeline::Region::Face));
    ThreadPool pool(pool_size());
    PipelineStages stages(std::move(pipeline), despite_drift ? WhenMoved::GoOn : WhenMoved::Refuse,
                          WhenUnjudged::GoOn);
    stages.add_by_hand(making_.by_hand);
    const hal::MonotonicClock clock;
    StageJob stage(stages, session_, pool, clock);
    std::atomic<State> now{State::Match};
    FunctionJob job([&](JobControl& control) -> Result<void> {
      const hal::Instant begin = clock.now();
      for (const State next : kStages) {
        if (next < first) continue;
        now.store(next, std::memory_order_relaxed);
        stage.choose(next);
        RELIEVO_TRY(stage.run(control));
        making_.records.push_back(stage.record());
      }
      report_.total = clock.now() - begin;
      return {};
    });
    const Result<void> done = run_watched(job, console, [&now] { return name_of(now.load()); });
    // A stage does not know the names of the files it works on.
    if (!done) return done.error().code == Errc::Cancelled ? done.error() : placed(done.error(), named);
  }
  const Products& made = session_.products();
  describe();
  report_.stages = making_.records;
  report_.by_hand = making_.by_hand.size();
  report_.drift = made.drift;
  report_.motion_px = made.matches->motion_px;
  report_.white = pipeline::measure_overexposure(*made.pair, *made.matches);
  return {};
}

void Reconstruction::describe() {
  report_.algorithms = making_.set.to_text();
  report_.peak_rss_bytes = peak_rss_bytes();
  report_.quality = model().quality;
  report_.landmarks = model().landmarks;
  report_.head_from_camera = model().head_from_camera;
}

Result<void> Reconstruction::save(const Path& document, const std::function<Result<void>()>& before) const {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, make_document(session_.products(), making_));
  return write_whole_file(document, bytes, before);
}

Result<pipeline::RecognitionImages> Reconstruction::draw_images() {
  EnrolmentSession::Scratch scratch(session_);
  return pipeline::make_recognition_images(model(), session_.output(), scratch.arena());
}

struct Reconstruction::Head {
  struct Shot {
    PicturePair pictures;
    pipeline::StereoCalibration calibration;
    Path left;
  };
  const pipeline::HeadPipeline& pipeline;
  std::span<const Shot> shots;
  Arena& kept;  // of the poses
  ThreadPool& pool;
  bool despite_drift;
  std::atomic<std::size_t> at{0};  // the shot that is worked on; as many as there are: all of them together
};

Result<void> Reconstruction::make_head(Head& head, JobControl& control) {
  const std::span<const Head::Shot> shots = head.shots;
  const pipeline::HeadPipeline& pipeline = head.pipeline;
  EnrolmentSession::Scratch room(session_);
  Arena &output = session_.output(), &scratch = room.arena();
  pipeline::StageContext context{output, scratch, head.pool, control.progress, control.cancelled};
  const auto timed = [&](std::string_view name, std::size_t pair, auto&& step) {
    head.at.store(pair, std::memory_order_relaxed);
    const hal::MonotonicClock clock;
    const hal::Instant begin = clock.now();
    scratch.wipe();
    auto done = step();
    StageRecord record;
    record.name = name;
    record.took = clock.now() - begin;
    record.in = pair == shots.size() ? pair : pair + 1;
    record.arena_peak_bytes = scratch.high_water();
    report_.stages.push_back(record);
    report_.total += record.took;
    return done;
  };
  std::vector<pipeline::HeadPose> poses;
  poses.reserve(shots.size());
  Products& made = session_.products();
  for (std::size_t k = 0; k < shots.size(); ++k) {
    if (k == 1) {  // the first pair fits its calibration
      auto face = timed(
          "Face", 0, [&] { return pipeline.face(shots[0].pictures.frame(), shots[0].calibration, context); });
      if (!face) return placed(face.error(), shots[0].left);
      made.model.emplace(*std::move(face));
    }
    const Arena::Mark mark(output);
    const auto added = timed("Pair", k, [&]() -> Result<void> {
      RELIEVO_TRY_ASSIGN(pipeline::HeadPose pose, pipeline.measure(shots[k].pictures.frame(),
                                                                   shots[k].calibration, context, head.kept));
      if (k == 0) report_.drift = pose.drift;
      if (pose.drift.verdict == pipeline::DriftVerdict::Refuse && !head.despite_drift)
        return error_of(pose.drift);
      poses.push_back(std::move(pose));
      return k == 0 ? Result<void>() : pipeline.place_last(*made.model, poses, context);
    });
    if (!added) return placed(added.error(), shots[k].left);
  }
  auto fused = timed("Fuse", shots.size(), [&] { return pipeline.fuse(*made.model, poses, context); });
  if (!fused) return fused.error();
  made.model = std::move(fused->model);
  report_.aliveness = fused->aliveness;
  report_.skin_moved_mm = fused->registration.skin_moved_mm;
  report_.poses.assign(fused->registration.poses.begin(), fused->registration.poses.end());
  return {};
}

Result<void> Reconstruction::run_head(const ReconstructArgs& args, Console& console) {
  RELIEVO_TRY_ASSIGN(making_.set, choose_algorithms(args.algorithms));
  RELIEVO_TRY_ASSIGN(const auto pipeline, pipeline::HeadPipeline::make(making_.set));
  std::vector<Head::Shot> shots(args.pictures.size() / 2);
  for (std::size_t k = 0; k < shots.size(); ++k) {
    shots[k].left = args.pictures[2 * k];
    RELIEVO_TRY_ASSIGN(shots[k].pictures, read_pair(shots[k].left, args.pictures[2 * k + 1]));
    const Path& file = args.calibrations[args.calibrations.size() == 1 ? 0 : k];
    RELIEVO_TRY_ASSIGN(shots[k].calibration, read_calibration_for(shots[k].pictures, file, shots[k].left));
  }
  RELIEVO_TRY(session_.open(""));
  const PageBlock block(shots.size() * budget::pose_bytes(budget::kMostFramePixels));
  Arena kept(block.bytes());
  ThreadPool pool(pool_size());
  Head head{pipeline, shots, kept, pool, args.despite_drift};
  FunctionJob job([&](JobControl& control) { return make_head(head, control); });
  RELIEVO_TRY(run_watched(job, console, [&head] {
    return std::string_view(head.at.load() == head.shots.size() ? "Fuse" : "Pair");
  }));
  report_.calibration = args.calibrations.front().string();
  describe();
  return {};
}

namespace {

std::string size_of(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

}  // namespace

Result<PicturePair> read_pair(const std::filesystem::path& left, const std::filesystem::path& right) {
  PicturePair pair;
  RELIEVO_TRY_ASSIGN(pair.left, hal::read_picture(left));
  RELIEVO_TRY_ASSIGN(pair.right, hal::read_picture(right));
  const std::string left_size = size_of(pair.left.width_px, pair.left.height_px);
  const std::string right_size = size_of(pair.right.width_px, pair.right.height_px);
  if (left_size != right_size) {
    return invalid("the two pictures differ in size: give a left and a right one of the same shot")
        .at(right.string() + " (" + right_size + ", left " + left_size + ")");
  }
  return pair;
}

Result<void> check_size(const pipeline::StereoCalibration& calibration, const hal::CaptureMode& pictures,
                        const std::string& place) {
  const std::string pictured = size_of(pictures.width_px, pictures.height_px);
  const std::string calibrated = size_of(calibration.left.width_px, calibration.left.height_px);
  if (pictured == calibrated) return {};
  return invalid("the calibration is for pictures of another size: calibrate at this one")
      .at(place + " (" + pictured + ", calibrated " + calibrated + ")");
}

Result<pipeline::StereoCalibration> read_calibration_for(const PicturePair& pair,
                                                         const std::filesystem::path& file,
                                                         const std::filesystem::path& left) {
  RELIEVO_TRY_ASSIGN(const auto calibration,
                     pipeline::read_calibration(file, {pair.left.width_px, pair.left.height_px, 0}));
  RELIEVO_TRY(check_size(calibration, {pair.left.width_px, pair.left.height_px}, left.string()));
  return calibration;
}

}  // namespace relievo::firmware
