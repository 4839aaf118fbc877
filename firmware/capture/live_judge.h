// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveJudge: the capture gate before the person at the screen. It keeps the gate's history of one visit,
// turns its measures into what the screen shows, and says where the face is in both whole pictures, for the
// light meter and the burst. The relief it measures with is handed on, to be drawn. After the frontal picture
// it follows the head that turns (pipeline/gate/turn). Thread: capture. Errors of open() and the looks: those
// of the gate, NotCalibrated; nobody in the picture is no error but an advice.
#pragma once

#include <bitset>
#include <chrono>
#include <memory>
#include <optional>

#include "firmware/capture/face_light.h"
#include "hal/clock.h"
#include "pipeline/gate/capture_gate.h"
#include "pipeline/gate/turn/turn_guide.h"
#include "pipeline/model/advice.h"

namespace relievo::firmware {

// Guidance: what the person at the screen is told about where they stand, with one live picture. Plain data.

// Of a head that turns after the frontal picture.
struct TurnGuidance {
  pipeline::TurnAdvice advice = pipeline::TurnAdvice::Lost;
  double yaw_deg = 0;  // against the front, + to the picture's right
  std::bitset<pipeline::kSides> taken;
};

struct Guidance {
  pipeline::Advice advice = pipeline::Advice::NoFace;
  double face_x = 0, face_y = 0;  // of the face from the middle of where it should be, in widths of a face:
                                  // the picture's right, down
  double ideal_width = 0;  // of a face at the best distance, share of the picture's width; 0: not known
  double nearness = 0;     // 1 at a good distance, 0.5 twice as far, 2 half as far; 0: not known
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;  // of the head: pipeline/gate/head/head_measurement.h
  double steady_s = 0;                              // so long no picture has had a reason
  std::optional<TurnGuidance> turn;
};

struct FaceBoxes {
  FaceBox left, right;  // of the whole pictures
};

struct LiveMeasurement {
  Guidance guidance;
  std::optional<FaceBoxes> face;
};

struct TurnMeasurement {
  Guidance guidance;                // with its turn
  std::optional<std::size_t> take;  // this pair shows that side
};

class LiveJudge {
 public:
  static Result<LiveJudge> open(const pipeline::StereoCalibration& calibration);
  // Of cameras that nobody has calibrated yet: use() comes before look().
  static Result<LiveJudge> open(int width_px);

  // Another calibration of the same cameras; while nobody poses.
  void use(const pipeline::StereoCalibration& calibration) { calibration_ = calibration; }
  // Somebody else may stand here.
  void begin() { history_ = {}; }
  Result<LiveMeasurement> look(const pipeline::StereoFrame& frame, hal::Instant now,
                               pipeline::StageContext& context);

  // The pair that was taken from the front. False: it shows no head that could be followed.
  Result<bool> begin_turn(const pipeline::StereoFrame& front, pipeline::StageContext& context);
  // `shutter`: for how long each picture is exposed.
  Result<TurnMeasurement> look_turned(const pipeline::StereoFrame& frame, hal::Instant now,
                                      std::chrono::microseconds shutter, pipeline::StageContext& context);
  void took(std::size_t side) { turn_.taken.set(side); }

 private:
  LiveJudge(pipeline::CaptureGate gate, const pipeline::LiveReliefOptions& relief)
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
Guidance guidance_of(const pipeline::GateAnswer& answer, const pipeline::StereoCalibration& calibration,
                     const pipeline::Relief& relief);

// Where a head whose nose is at `tip_mm`, in the frame of the relief, is in the pictures of both cameras.
FaceBoxes face_boxes(const pipeline::StereoCalibration& calibration,
                     const pipeline::Rotation& rectified_from_left, const pipeline::Vec3d& tip_mm);

}  // namespace relievo::firmware
