// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceWatch: where faces are in the small live picture, fast enough for every picture (Haar cascades: Viola
// and Jones 2001; Lienhart 2002). It asks less than FaceFinder (match/region): faces of a size that people at
// the machine have, and other tries than the first only where that finds nothing. What it misses or imagines,
// the relief and the history set right. Thread: one caller at a time. Memory: OpenCV's own, bounded by the
// size of the picture.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "hal/base/result.h"
#include "pipeline/match/region/face_region.h"
#include "pipeline/model/relief.h"

namespace relievo::pipeline {

// Pixels of the relief; 4 votes are doubtful, 30 certain.
struct FaceHits {
  std::array<FaceBox, 8> hit{};  // the most certain one first
  int count = 0;
};

class FaceWatch {
 public:
  // Errors: NotFound, StoreCorrupt (a cascade's SHA-256), LibraryFailed.
  static Result<FaceWatch> open(const std::string& cascade_folder);
  // Errors: InvalidInput (no pixels), LibraryFailed. No face is no error: count is 0.
  Result<FaceHits> look(const Relief& relief);

 private:
  struct Cascades;
  explicit FaceWatch(std::shared_ptr<Cascades> cascades) : cascades_(std::move(cascades)) {}
  std::shared_ptr<Cascades> cascades_;
};

}  // namespace relievo::pipeline
