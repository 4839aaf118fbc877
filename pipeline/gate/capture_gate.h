// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CaptureGate: judges the live pair and answers with one piece of advice, the first that holds in the order
// of Advice. None means: take it. look() is a function of the pictures, the time and the history, which is
// plain data of fixed size: the same of these gives the same answer. What a person is told changes only when
// a reason was seen twice; `reason` is this picture's own, and `steady` is how long no picture has had one:
// nothing may be taken while `reason` is not None. Memory: the relief in context.output, the rest in
// context.scratch; OpenCV's cascades use their own, bounded by the size of the picture. Thread: one caller at
// a time. Errors of look(): those of LiveRelief and FaceWatch.
#pragma once

#include <chrono>
#include <string>

#include "pipeline/gate/face/face_watch.h"
#include "pipeline/gate/judgement.h"
#include "pipeline/gate/relief/live_relief.h"

namespace relievo::pipeline {

using GateTime = std::chrono::nanoseconds;  // of the exposure, on any steady clock

// A head as one picture showed it.
struct SeenHead {
  GateTime at{};
  bool by_cascade = false;
  Vec3d tip_mm;
  double yaw_deg = 0;
  HeadHint face;
};

struct GateHistory {
  bool seen = false;  // a head, in the picture before
  GateTime last_by_cascade{};
  SeenHead last, from;  // from: what motion is measured against, kShortestMotion ago or more
  double speed_mm_s = 0, turn_deg_s = 0;
  Advice said = Advice::NoFace;   // to the person
  Advice heard = Advice::NoFace;  // the reason of the picture before
  GateTime good_since{};          // where that was none
};

struct GateAnswer {
  Advice advice = Advice::NoFace;  // for the person
  Advice reason = Advice::NoFace;  // of this picture
  GateTime steady{};               // no picture has had a reason for so long
  GateMeasures measures;
};

struct GateLook {
  GateAnswer answer;
  Relief relief;
};

class CaptureGate {
 public:
  // Errors: InvalidInput, and those of FaceWatch::open().
  static Result<CaptureGate> open(const LiveRelief& relief = {},
                                  const std::string& cascade_folder = kCascadeFolder);
  Result<GateLook> look(const StereoFrame& frame, const StereoCalibration& calibration, GateTime now,
                        GateHistory& history, StageContext& context);

 private:
  CaptureGate(const LiveRelief& relief, FaceWatch watch) : relief_(relief), watch_(std::move(watch)) {}
  LiveRelief relief_;
  FaceWatch watch_;
};

}  // namespace relievo::pipeline
