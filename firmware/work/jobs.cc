// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/jobs.h"

#include <thread>

#include "firmware/work/stage_drawing.h"
#include "hal/base/assert.h"

namespace relievo::firmware {

Result<void> HeadJob::run(JobControl& control) {
  records_.clear();
  parts_done_ = 0;
  for (const State stage : kStages) {
    JobControl inner{control.cancelled, inner_};
    choose(stage);
    RELIEVO_TRY(StageJob::run(inner));
    records_.push_back(record());
    parts_done_.fetch_add(1, std::memory_order_release);
  }
  std::vector<pipeline::HeadPose> poses;
  return add_sides(control, poses);
}

Result<void> HeadJob::add_sides(JobControl& control, std::vector<pipeline::HeadPose>& poses) {
  int lost = 0;
  lost_.reset();
  const auto lose = [&](const Error& why, int sides) {
    lost += sides;
    lost_ = why;
  };
  poses.reserve(SidePairs::kPoses);
  while (const auto side = session_.sides().next(control.cancelled)) {
    // What is wrong with a pair here spoils no face. Without the front's pose there is nothing to join it to.
    Result<void> done;
    if (poses.empty()) done = measure(*session_.products().frame, control, poses);
    if (done) done = measure(*side, control, poses);
    if (!done) lose(done.error(), 1);
    parts_done_.fetch_add(1, std::memory_order_release);
  }
  parts_done_.store(PortraitProgress::kFuse, std::memory_order_release);
  if (poses.size() > 1)
    if (const Result<void> fused = fuse(control, poses); !fused) {
      // Whose eyes were not alive while the head turned is refused, with the face from in front.
      if (fused.error().code == Errc::NoFace) return fused.error();
      lose(fused.error(), int(poses.size()) - 1);
    }
  if (session_.products().model) session_.products().model->poses_left_out += lost;
  if (control.cancelled.load()) return Error{Errc::Cancelled, "stopped while the head was made"};
  return {};
}

Result<void> HeadJob::measure(const pipeline::StereoFrame& pair, JobControl& control,
                              std::vector<pipeline::HeadPose>& poses) {
  Arena& kept = session_.sides().kept(poses.size());
  kept.reset();  // of a pose that came to nothing
  const auto add = [&](pipeline::StageContext& context) {
    const Arena::Mark mark(session_.output());
    return runner_.add_pose(pair, *session_.products().model, poses, context, kept);
  };
  RELIEVO_TRY(timed("Pose", inner_, control.cancelled,
                    [&](pipeline::StageContext& context) { return pipeline::run_stage(context, add); }));
  record_.in = poses.size();
  records_.push_back(record_);
  return {};
}

Result<void> HeadJob::fuse(JobControl& control, std::vector<pipeline::HeadPose>& poses) {
  Products& made = session_.products();
  const auto join = [&](pipeline::StageContext& context) {
    return runner_.fuse(*made.model, poses, context);
  };
  RELIEVO_TRY_ASSIGN(pipeline::FusedHead head,
                     timed("Fuse", inner_, control.cancelled, [&](pipeline::StageContext& context) {
                       return pipeline::run_stage(context, join);
                     }));
  made.model = std::move(head.model);
  made.registration = std::move(head.registration);
  record_.in = poses.size();
  record_.out = made.model->mesh.triangles.size();
  records_.push_back(record_);
  return {};
}

namespace {

constexpr std::size_t kReliefShare = 8;  // of the memory: an eighth for the reliefs, the rest to make them

constexpr int kMeterEvery = 3;  // live pairs: a camera that runs on its own obeys one or two later

constexpr double kSkinShare = 0.5;  // of the face's box, about its middle: a window beside the cheeks is not
                                    // lit for, also where the box is not quite right

FaceBox skin_in(const FaceBox& face) {
  const int width = int(kSkinShare * face.width_px), height = int(kSkinShare * face.height_px);
  return {face.x_px + (face.width_px - width) / 2, face.y_px + (face.height_px - height) / 2, width, height};
}

}  // namespace

Result<void> TurnJob::run(JobControl& control) {
  const std::span<std::byte> block = session_.follow_block();
  Arena output(block.first(block.size() / kReliefShare)), scratch(block.subspan(block.size() / kReliefShare));
  const Finally at_the_end{[&] {
    if (judge_ != nullptr) judge_->forget();
    output.wipe();
    scratch.wipe();
    session_.sides().end();  // HeadJob waits for it
  }};
  return judge_ == nullptr ? Result<void>() : follow(control, output, scratch);
}

Result<void> TurnJob::follow(JobControl& control, Arena& output, Arena& scratch) {
  pipeline::StageContext context{output, scratch, alone_, control.progress, control.cancelled};
  RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
  RELIEVO_TRY_ASSIGN(const bool can_follow, judge_->begin_turn(front_, context));
  if (!can_follow) return {};
  const auto set = pose_.exposure().exposure().time;
  const auto shutter = set.count() > 0 ? set : kFirstExposure.time;
  hal::Instant last_side = device_.clock().now();
  while (!enough_.load() && session_.sides().count() < pipeline::kSides &&
         device_.clock().now() - last_side < budget::kTurnPatience) {
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the sides are no longer waited for"};
    output.reset();
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame,
                       grabber_.grab(session_.free_slot(), control.cancelled));
    session_.live().fill(frame.left);
    RELIEVO_TRY_ASSIGN(const TurnMeasurement seen,
                       judge_->look_turned(frame, device_.clock().now(), shutter, context));
    session_.live().publish(seen.guidance);
    if (seen.take) {
      RELIEVO_TRY(take(frame, control));
      judge_->took(*seen.take);
      last_side = device_.clock().now();
    }
    std::this_thread::sleep_for(budget::kLivePause);
  }
  return {};
}

Result<void> TurnJob::take(const pipeline::StereoFrame& seen, JobControl& control) {
  if (device_.shot_light() == hal::Light::Off) return session_.sides().add(seen);
  BurstOptions options;
  options.pairs = 1;
  options.light = device_.shot_light();
  StereoSlot& slot = session_.free_slot();
  RELIEVO_TRY_ASSIGN(const BurstResult lit, take_burst(grabber_, slot, slot, options, control.cancelled));
  return session_.sides().add(lit.frame);
}

Result<void> open_cameras(StereoGrabber& grabber, const hal::CaptureMode& mode, const hal::Clock& clock,
                          JobControl& control) {
  const hal::Instant until = clock.now() + budget::kCameraReturn;
  for (;;) {
    Result<void> started = grabber.start(mode);
    if (started || grabber.watch() == CameraWatch::Well || clock.now() >= until) return started;
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the cameras are no longer waited for"};
    std::this_thread::sleep_for(budget::kTick / 2);
  }
}

Result<pipeline::StereoFrame> take_and_forget(StereoGrabber& grabber, EnrolmentSession& session,
                                              hal::Device& device, const std::atomic<bool>& cancelled) {
  RELIEVO_TRY(grabber.start(device.preferred_mode()));
  StereoSlot& slot = session.free_slot();
  const auto pair = grabber.grab(slot, cancelled);
  slot.wipe();  // whoever passes by is in the pictures
  return pair;
}

Result<void> PoseJob::run(JobControl& control) {
  RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
  RELIEVO_TRY(grabber_.check_cameras());
  const hal::Exposure known = exposure_.exposure();
  RELIEVO_TRY(exposure_.begin(known.time.count() > 0 ? known : kFirstExposure));
  const Finally at_the_end{[this] {
    if (judge_ != nullptr) judge_->forget();
  }};
  face_.reset();
  pairs_ = 0;
  while (!control.cancelled.load(std::memory_order_relaxed)) {
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame, grabber_.grab(session_.slot(), control.cancelled));
    session_.live().fill(frame.left);
    ui::LiveView guidance;
    if (judge_ != nullptr) {
      RELIEVO_TRY_ASSIGN(guidance, judge(frame, control));
    }
    session_.live().publish(guidance);
    std::this_thread::sleep_for(budget::kLivePause);
  }
  return Error{Errc::Cancelled, "nobody looks at the live picture any more"};
}

// The pool is the worker's, which rests while somebody poses.
Result<ui::LiveView> PoseJob::judge(const pipeline::StereoFrame& frame, JobControl& control) {
  const Arena::Mark mark(session_.output());
  EnrolmentSession::Scratch scratch(session_);
  pipeline::StageContext context{session_.output(), scratch.arena(), pool_, control.progress,
                                 control.cancelled};
  RELIEVO_TRY_ASSIGN(const LiveMeasurement measured, judge_->look(frame, device_.clock().now(), context));
  face_ = measured.face;
  RELIEVO_TRY(meter(frame));
  return measured.guidance;
}

// Where no face is known, the middle of the picture is lit for.
Result<void> PoseJob::meter(const pipeline::StereoFrame& frame) {
  if (pairs_++ % kMeterEvery != 0) return {};
  const auto left = face_light(frame.left, face_ ? skin_in(face_->left) : middle_box(frame.left));
  const auto right = face_light(frame.right, face_ ? skin_in(face_->right) : middle_box(frame.right));
  if (!left || !right) return {};  // half out of the picture: the person is told to come in
  return exposure_.step(*left, *right);
}

Result<void> GrabJob::run(JobControl& control) {
  RELIEVO_TRY(grabber_.start(device_.preferred_mode()));  // nothing where the streams run already
  RELIEVO_TRY(grabber_.check_cameras());                  // others than the calibrated ones measure nothing
  BurstOptions options;
  options.light = device_.shot_light();
  if (!device_.is_live()) {
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame, grabber_.grab(session_.slot(), control.cancelled));
    took(frame);
    return {};
  }
  if (pose_.face()) options.face = pose_.face()->left;
  ExposureControl& exposure = pose_.exposure();
  // Still metering: both have the same exposure all the same, and nobody changes it now.
  if (exposure.state() != ExposureControl::State::Metering) RELIEVO_TRY(exposure.lock());
  Result<BurstResult> burst =
      take_burst(grabber_, session_.slot(), session_.spare_slot(), options, control.cancelled);
  if (!burst && burst.error().code == Errc::InvalidInput &&
      options.face) {  // the face box reaches out of a picture
    options.face.reset();
    burst = take_burst(grabber_, session_.slot(), session_.spare_slot(), options, control.cancelled);
  }
  exposure.unlock();
  if (!burst) return burst.error();
  took(burst->frame);
  return {};
}

void GrabJob::took(const pipeline::StereoFrame& frame) {
  session_.took(frame);
  const auto& face = pose_.face();
  draw_capture(frame.left, face ? std::optional(face->left) : std::nullopt, session_.stage_pictures());
}

Result<void> StageJob::run(JobControl& control) {
  stand_behind_the_page();
  session_.begins(stage_);
  Result<void> done =
      timed(name_of(stage_), control.progress, control.cancelled, [this](pipeline::StageContext& context) {
        return runner_.run(stage_, session_.products(), context, record_);
      });
  if (done) draw_stage_picture(stage_, session_.products(), session_.stage_pictures());
  return done;
}

}  // namespace relievo::firmware
