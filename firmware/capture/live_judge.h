// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveJudge: the capture gate before the person at the screen. It keeps the gate's history of one visit,
// turns its measures into what the screen shows, and says where the face is in both whole pictures, for the
// light meter and the burst. The relief it measures with is handed on, to be drawn. After the frontal picture
// it follows the head that turns (pipeline/gate/turn). Thread: capture. Errors of open() and the looks: those
// of the gate, NotCalibrated; nobody in the picture is no error but an advice.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "firmware/capture/face_light.h"
#include "hal/clock.h"
#include "pipeline/gate/capture_gate.h"
#include "pipeline/gate/turn/turn_guide.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

struct FaceBoxes {
  FaceBox left, right;  // of the whole pictures
};

struct LiveMeasurement {
  ui::LiveView guidance;  // without its picture, as everywhere here
  std::optional<FaceBoxes> face;
};

struct TurnMeasurement {
  ui::LiveView guidance;            // with its turn
  std::optional<std::size_t> take;  // this pair shows that side
};

class LiveJudge {
 public:
  static Result<LiveJudge> open(const pipeline::StereoCalibration& calibration);
  // Of cameras that nobody has calibrated yet: use() comes before look().
  static Result<LiveJudge> open(int width_px);

  // Another calibration of the same cameras; while nobody poses.
  void use(const pipeline::StereoCalibration& calibration) { calibration_ = calibration; }
  // Whose look or turn has ended may leave: nothing stays of their face and of where it was.
  void forget();
  Result<LiveMeasurement> look(const pipeline::StereoFrame& frame, hal::Instant now,
                               pipeline::StageContext& context);

  // The pair that was taken from the front. False: it shows no head that could be followed.
  Result<bool> begin_turn(const pipeline::StereoFrame& front, pipeline::StageContext& context);
  // `shutter`: for how long each picture is exposed.
  Result<TurnMeasurement> look_turned(const pipeline::StereoFrame& frame, hal::Instant now,
                                      std::chrono::microseconds shutter, pipeline::StageContext& context);
  void took(std::size_t side) { turn_.taken.set(side); }

 private:
  LiveJudge(pipeline::CaptureGate gate, const pipeline::LiveRelief& relief)
      : gate_(std::move(gate)), relief_(relief) {}

  pipeline::CaptureGate gate_;
  pipeline::LiveRelief relief_;
  // Taken once, with the judge: it is too large for a stack.
  std::unique_ptr<pipeline::FrontFace> front_ = std::make_unique<pipeline::FrontFace>();
  pipeline::TurnHistory turn_;
  std::optional<pipeline::StereoCalibration> calibration_;
  pipeline::GateHistory history_;
};

// Of a device that nobody has calibrated yet: NotCalibrated, and who can help.
Error uncalibrated();

// How often its pictures are made smaller before they are judged.
int judged_reduction(int width_px);

// Where somebody stands, as the screen shows it. Who is too near or too far for the relief is placed by the
// picture alone.
ui::LiveView guidance_of(const pipeline::GateAnswer& answer, const pipeline::StereoCalibration& calibration,
                         const pipeline::Relief& relief);

// Where a head whose nose is at `tip_mm`, in the frame of the relief, is in the pictures of both cameras.
FaceBoxes face_boxes(const pipeline::StereoCalibration& calibration,
                     const pipeline::Rotation& rectified_from_left, const pipeline::Vec3d& tip_mm);

}  // namespace relievo::firmware
