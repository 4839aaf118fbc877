// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RecognitionImages: a face as recognition programs want it, both in the head frame (origin at the tip
// of the nose, x to the person's left, y up, z out of the face, millimetres).
// Pixel (0, 0) is the centre of the upper left pixel; seen from the front, so +x is to the right.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// What a pixel shows.
inline constexpr std::uint8_t kNothingShown = 0, kCompletedShown = 1, kMeasuredShown = 2;

// A frontal portrait, drawn from the model as a camera straight before the face would see it.
struct Portrait : PixelGrid {
  explicit Portrait(std::pmr::memory_resource* memory) : rgb(memory), shows(memory) {}
  std::pmr::vector<std::uint8_t> rgb;    // 3 a pixel, coded as the photographs
  std::pmr::vector<std::uint8_t> shows;  // 1 a pixel: kNothingShown (background), kCompletedShown (filled),
                                         // kMeasuredShown (photographed)
  double mm_per_px = 0;                  // in the plane of the eyes
  double camera_mm = 0;                  // from that plane
  Vec3d eyes_mm;                         // midpoint between the eyes, head frame
  Vec2d eyes_px;                         // where it lies in the picture
  double between_eyes_mm = 0;            // 0 where the eyes were not found: eyes_mm is then what is typical
  Vec2d right_eye_px, left_eye_px;       // the person's; where both were found

  // Where a point of the head falls in the picture.
  Vec2d place_of(const Vec3d& at_mm) const {
    const double px_per_mm = camera_mm / mm_per_px / (camera_mm + eyes_mm.z - at_mm.z);
    return {eyes_px.x + (at_mm.x - eyes_mm.x) * px_per_mm, eyes_px.y - (at_mm.y - eyes_mm.y) * px_per_mm};
  }
};

// The surface as heights over a grid: what z the outermost surface has at each x, y.
struct RangeImage : PixelGrid {
  explicit RangeImage(std::pmr::memory_resource* memory) : z_mm(memory), sigma_mm(memory), shows(memory) {}
  std::pmr::vector<float> z_mm;      // 1 a pixel; 0 where nothing is shown
  std::pmr::vector<float> sigma_mm;  // one standard deviation along z; 0 where nothing is shown
  std::pmr::vector<std::uint8_t> shows;
  double pitch_mm = 0;  // of the grid
  Vec2d first_mm;       // x and y of pixel (0, 0); x = first.x + pitch * column, y = first.y - pitch * row
};

struct RecognitionImages {
  explicit RecognitionImages(std::pmr::memory_resource* memory) : portrait(memory), range(memory) {}
  Portrait portrait;
  RangeImage range;
};

}  // namespace relievo::pipeline
