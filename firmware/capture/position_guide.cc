// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/position_guide.h"

#include <algorithm>
#include <cmath>

namespace relievo::firmware {
namespace {

constexpr double kFaceWidthMm = 150;  // what FaceBox::width_px stands for

// Mean grey of the middle of the face, where hair and background do not count.
double mean_grey(const ImageView& small, const pipeline::FaceBox& face) {
  const int half = std::max(1, static_cast<int>(face.width_px * 0.35));
  const int cx = static_cast<int>(face.centre_px.x), cy = static_cast<int>(face.centre_px.y);
  double sum = 0;
  int count = 0;
  for (int y = std::max(0, cy - half); y < std::min(small.height_px, cy + half); y += 2) {
    for (int x = std::max(0, cx - half); x < std::min(small.width_px, cx + half); x += 2, ++count) {
      const std::uint8_t* p = small.row(y) + 3 * x;
      sum += 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    }
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

pipeline::Advice PositionGuide::judge(const ImageView& small, const pipeline::FaceBox& face, double distance_mm, const Guidance& guidance) const {
  using pipeline::Advice;
  if (distance_mm < limits_.nearest_mm) return Advice::TooClose;
  if (distance_mm > limits_.farthest_mm) return Advice::TooFar;
  if (std::abs(guidance.face_x) > limits_.off_across || std::abs(guidance.face_y) > limits_.off_down) return Advice::OffCentre;
  const double grey = mean_grey(small, face);
  if (grey < limits_.dark) return Advice::TooDark;
  if (grey > limits_.bright) return Advice::TooBright;
  const double dx = face.centre_px.x - last_.centre_px.x, dy = face.centre_px.y - last_.centre_px.y;
  if (known_ && std::hypot(dx, dy) > limits_.moved * face.width_px) return Advice::Moved;
  return Advice::None;
}

Result<Guidance> PositionGuide::look(const ImageView& small, int whole_width_px, hal::Instant now, const std::atomic<bool>* cancelled) {
  Guidance guidance;
  const double focal = focal_px_ * small.width_px / whole_width_px;
  guidance.ideal_width = focal * kFaceWidthMm / best_mm_ / small.width_px;
  const Result<pipeline::FaceBox> face = finder_.find(small, cancelled);
  if (!face && face.error().code != Errc::NoFace) return face.error();
  if (!face) {
    steady_ = known_ = false;
    return guidance;
  }
  guidance.face_x = (face->centre_px.x - small.width_px / 2.0) / face->width_px;
  guidance.face_y = (face->centre_px.y - small.height_px / 2.0) / face->width_px;
  guidance.advice = judge(small, *face, focal * kFaceWidthMm / face->width_px, guidance);
  last_ = *face;
  known_ = true;
  if (guidance.advice != pipeline::Advice::None) {
    steady_ = false;
    return guidance;
  }
  if (!steady_) steady_since_ = now;
  steady_ = true;
  guidance.steady_s = std::chrono::duration<double>(now - steady_since_).count();
  return guidance;
}

}  // namespace relievo::firmware
