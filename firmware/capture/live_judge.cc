// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/live_judge.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "pipeline/match/rectify/rectifier.h"

namespace relievo::firmware {
namespace {

constexpr int kJudgedWidthPx = 480;  // about: the pictures the gate measures in
constexpr double kFaceWidthMm = 150, kFaceHeightMm = 190;
constexpr double kUpMm = 12;  // of the face's middle above the tip of the nose

// Where the two cameras' axes come nearest to each other: there a face is seen best.
double best_distance_mm(const pipeline::StereoCalibration& c) {
  const double sine = std::hypot(c.right_from_left.rotation.m[2], c.right_from_left.rotation.m[5]);
  const auto& t = c.right_from_left.translation_mm;
  const double baseline = std::hypot(t.x, t.y, t.z);
  return sine > 0.05 ? std::clamp(baseline / sine, 450.0, 650.0) : 560.0;
}

FaceBox box_at(const pipeline::CameraIntrinsics& camera, const pipeline::Vec3d& tip_mm) {
  const pipeline::Vec2d at =
      pipeline::source_pixel(camera, {}, 1, {0, 0}, {tip_mm.x / tip_mm.z, (tip_mm.y - kUpMm) / tip_mm.z});
  const double a_mm = camera.focal_px.x / tip_mm.z, width = kFaceWidthMm * a_mm,
               height = kFaceHeightMm * a_mm;
  return {int(std::lround(at.x - width / 2)), int(std::lround(at.y - height / 2)), int(width), int(height)};
}

}  // namespace

Error uncalibrated() {
  return {Errc::NotCalibrated,
          "this device has no calibration yet: a technician has to calibrate its cameras"};
}

FaceBoxes face_boxes(const pipeline::StereoCalibration& calibration,
                     const pipeline::Rotation& rectified_from_left, const pipeline::Vec3d& tip_mm) {
  const pipeline::Vec3d in_left = apply(transposed(rectified_from_left), tip_mm);
  return {box_at(calibration.left, in_left),
          box_at(calibration.right, apply(calibration.right_from_left, in_left))};
}

int judged_reduction(int width_px) {
  return std::max(1, int(std::lround(double(width_px) / kJudgedWidthPx)));
}

Result<LiveJudge> LiveJudge::open(const pipeline::StereoCalibration& calibration) {
  RELIEVO_TRY_ASSIGN(LiveJudge judge, open(calibration.left.width_px));
  judge.use(calibration);
  return judge;
}

Result<LiveJudge> LiveJudge::open(int width_px) {
  const pipeline::LiveRelief relief{.reduction = judged_reduction(width_px)};
  RELIEVO_TRY_ASSIGN(auto gate, pipeline::CaptureGate::open(relief));
  return LiveJudge(std::move(gate), relief);
}

ui::LiveView guidance_of(const pipeline::GateAnswer& answer, const pipeline::StereoCalibration& calibration,
                         const pipeline::Relief& relief) {
  const pipeline::GateMeasures& m = answer.measures;
  ui::LiveView view;
  view.advice = answer.advice;
  view.ideal_width = float(calibration.left.focal_px.x * kFaceWidthMm / best_distance_mm(calibration) /
                           calibration.left.width_px);
  const double z_mm = m.head.known ? m.head.tip_mm.z : m.guessed_mm;
  constexpr pipeline::GateLimits kVolume;
  if (z_mm > 0) view.nearness = float(std::clamp(z_mm, kVolume.nearest_mm, kVolume.farthest_mm) / z_mm);
  view.steady_s = float(std::chrono::duration<double>(answer.steady).count());
  if (m.head.known) {
    view.face_x = float(m.off_right_mm / kFaceWidthMm);
    view.face_y = float(m.off_down_mm / kFaceWidthMm);
  } else if (m.face.width_px > 0) {
    view.face_x = float((m.face.centre_px.x - relief.width_px / 2.0) / m.face.width_px);
    view.face_y = float((m.face.centre_px.y - relief.height_px / 2.0) / m.face.width_px);
  } else {
    // About as many faces as the picture has room for.
    view.face_x = float(2 * m.somebody_right);
    view.face_y = float(m.somebody_down);
  }
  view.yaw_deg = float(m.head.yaw_deg);
  view.pitch_deg = float(m.head.pitch_deg);
  view.roll_deg = float(m.head.roll_deg);
  return view;
}

void LiveJudge::forget() {
  static_assert(std::is_trivially_copyable_v<pipeline::FrontFace>);
  explicit_bzero(front_.get(), sizeof *front_);
  turn_ = {};
  history_ = {};
}

Result<bool> LiveJudge::begin_turn(const pipeline::StereoFrame& front, pipeline::StageContext& context) {
  forget();
  if (!calibration_) return uncalibrated();
  pipeline::GateHistory nothing;
  RELIEVO_TRY_ASSIGN(const pipeline::GateLook look,
                     pipeline::run_stage(context, [&](pipeline::StageContext& c) {
                       return gate_.look(front, *calibration_, {}, nothing, c);
                     }));
  front_face(look.relief, look.answer.measures.head, *front_);
  return front_->count > 0;
}

Result<TurnMeasurement> LiveJudge::look_turned(const pipeline::StereoFrame& frame, hal::Instant now,
                                               std::chrono::microseconds shutter,
                                               pipeline::StageContext& context) {
  if (!calibration_) return uncalibrated();
  RELIEVO_TRY_ASSIGN(const pipeline::Relief relief,
                     pipeline::run_stage(context, [&](pipeline::StageContext& c) {
                       return relief_.look(frame, *calibration_, c);
                     }));
  const pipeline::HeadTurn turn = follow_head(*front_, relief, turn_.last);
  const double px_per_mm = calibration_->left.focal_px.x / front_->pivot_mm.z;
  const double slow_mm_s =
      pipeline::kMostSmearPx / px_per_mm / std::chrono::duration<double>(shutter).count();
  const pipeline::TurnAnswer answer = guide_turn(*front_, turn, now.time_since_epoch(), slow_mm_s, turn_);
  TurnMeasurement measured{{}, answer.take};
  measured.guidance.turn = ui::TurnView{answer.advice, float(turn.yaw_deg), turn_.taken};
  return measured;
}

Result<LiveMeasurement> LiveJudge::look(const pipeline::StereoFrame& frame, hal::Instant now,
                                        pipeline::StageContext& context) {
  if (!calibration_) return uncalibrated();
  RELIEVO_TRY_ASSIGN(const pipeline::GateLook look,
                     pipeline::run_stage(context, [&](pipeline::StageContext& c) {
                       return gate_.look(frame, *calibration_, now.time_since_epoch(), history_, c);
                     }));
  const pipeline::HeadMeasurement& head = look.answer.measures.head;
  std::optional<FaceBoxes> face;
  if (head.known) face = face_boxes(*calibration_, look.relief.rectified_from_left, head.tip_mm);
  return LiveMeasurement{guidance_of(look.answer, *calibration_, look.relief), face};
}

}  // namespace relievo::firmware
