// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/relief/relief_trial.h"

#include "pipeline/fuse/head_pipeline.h"
#include "tests/support/rig_calibration.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: a bench of the pipeline

Result<void> reconstruct(const Pipeline& stages, const hal::sim::PicturePair& pictures,
                         test::StageFixture& room, Verdict& verdict) {
  const StereoFrame frame{pictures.left.view(), pictures.right.view(), 0, 0};
  RELIEVO_TRY_ASSIGN(auto pair, stages.rectify(frame, room.context));
  RELIEVO_TRY_ASSIGN(const auto matches, stages.match(pair, room.context));
  RELIEVO_TRY_ASSIGN(const auto cloud, stages.reconstruct(pair, matches, room.context));
  RELIEVO_TRY_ASSIGN(auto mesh, stages.mesh(cloud, pair, room.context));
  // What was measured is told of everything, also of what is refused.
  const auto relief = run_stage(room.context, [&](StageContext& c) { return measure_relief(mesh, pair, c); });
  if (relief) verdict.relief = *relief;
  RELIEVO_TRY_ASSIGN(auto texture, stages.texture(mesh, pair, room.context));
  const auto model = stages.assemble(std::move(mesh), std::move(texture), pair, room.context);
  if (!model) return model.error();
  return model->unjudged ? Result<void>(*model->unjudged) : Result<void>{};
}

Result<void> fuse(std::span<const Trial> trials, std::span<const hal::sim::PicturePair> pictures,
                  test::StageFixture& room, Arena& kept, Verdict& verdict) {
  const StereoCalibration calibration = test::true_calibration(make_rig(trials.front().rig));
  RELIEVO_TRY_ASSIGN(const HeadPipeline pipeline, HeadPipeline::make({}));
  const auto frame = [&](std::size_t k) {
    return StereoFrame{pictures[k].left.view(), pictures[k].right.view(), 0, 0};
  };
  RELIEVO_TRY_ASSIGN(const FaceModel face, pipeline.face(frame(0), calibration, room.context));
  if (face.unjudged) return *face.unjudged;
  std::vector<HeadPose> poses;
  for (std::size_t k = 0; k < trials.size(); ++k) {
    const Arena::Mark mark(room.output);
    RELIEVO_TRY_ASSIGN(HeadPose pose, pipeline.measure(frame(k), calibration, room.context, kept));
    poses.push_back(std::move(pose));
  }
  RELIEVO_TRY_ASSIGN(const FusedHead head, pipeline.fuse(face, poses, room.context));
  verdict.aliveness = head.aliveness;
  return head.model.unjudged ? Result<void>(*head.model.unjudged) : Result<void>{};
}

Verdict verdict_of(const Result<void>& done, Verdict verdict) {
  verdict.accepted = done.has_value();
  if (!done) verdict.why = std::string(done.error().what.view());
  return verdict;
}

}  // namespace

Verdict judge_turning(std::span<const Trial> trials, std::span<const hal::sim::PicturePair> pictures,
                      test::StageFixture& room, Arena& kept) {
  room.output.reset();
  kept.reset();
  Verdict verdict;
  const Result<void> done = fuse(trials, pictures, room, kept, verdict);
  return verdict_of(done, verdict);
}

hal::sim::PicturePair photograph(const Trial& trial, ThreadPool& pool) {
  return render_pair(*trial.scene, make_rig(trial.rig), trial.sensor, trial.noise_seed, pool);
}

Verdict judge(const Trial& trial, const hal::sim::PicturePair& pictures, test::StageFixture& room) {
  room.output.reset();
  Verdict verdict;
  const auto stages = Pipeline::make({}, test::true_calibration(make_rig(trial.rig)));
  const Result<void> done =
      stages ? reconstruct(*stages, pictures, room, verdict) : Result<void>(stages.error());
  return verdict_of(done, verdict);
}

}  // namespace relievo::bench
