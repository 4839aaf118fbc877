// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PositionGuide: from one small picture to one piece of advice: is there a face, where it should be,
// near enough, lit enough, and still? The distance comes from the width of a grown-up's face: good
// enough to send somebody a step back. Pixels, millimetres.
// Thread: capture. Errors of look(): those of the face finder, but not NoFace: that is an advice.
#pragma once

#include <atomic>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/clock.h"
#include "pipeline/match/region/face_region.h"
#include "pipeline/model/advice.h"

namespace relievo::firmware {

struct PositionLimits {
  double nearest_mm = 430, farthest_mm = 700;    // inside the depth that is searched for a surface
  double off_across = 0.28, off_down = 0.34;     // of the face's middle, in widths of the face
  double dark = 40, bright = 222;                // mean grey of the face
  double moved = 0.10;                           // between two pictures, in widths of the face
};

struct Guidance {
  pipeline::Advice advice = pipeline::Advice::NoFace;
  double face_x = 0, face_y = 0;     // middle of the face from the middle of the picture, in widths of the face
  double ideal_width = 0;            // of a face at the best distance, share of the picture's width; 0: not known
  double steady_s = 0;               // so long everything has been right
};

class PositionGuide {
 public:
  // `focal_px` of the whole picture; `best_mm` is where the cameras' axes meet.
  PositionGuide(pipeline::FaceFinder finder, double focal_px, double best_mm, const PositionLimits& limits = {})
      : finder_(std::move(finder)), focal_px_(focal_px), best_mm_(best_mm), limits_(limits) {}

  void begin() { steady_ = known_ = false; }
  Result<Guidance> look(const ImageView& small, int whole_width_px, hal::Instant now, const std::atomic<bool>* cancelled);

 private:
  pipeline::Advice judge(const ImageView& small, const pipeline::FaceBox& face, double distance_mm, const Guidance& guidance) const;

  pipeline::FaceFinder finder_;
  double focal_px_, best_mm_;
  PositionLimits limits_;
  bool steady_ = false, known_ = false;
  hal::Instant steady_since_{};
  pipeline::FaceBox last_;
};

}  // namespace relievo::firmware
