// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FileSelector ("file-points"): the keypoints of a text file, one a line (number_lines.h): x and y in pixels
// of the left rectified view; further columns are not looked at. What lies outside of the face region is left
// out; the same place is taken once; keypoints are in rows from the top. Errors: NotFound (none is named, or
// it was not read); InvalidInput with the line's number: not two numbers, or outside of the view; NoFace
// (none in the face region); OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct FileSelector {
  TextFile file;

  void describe(auto&& field) {
    field("path", file, OptionRange{0, 0},
          "text file of keypoints: x,y in pixels of the left rectified view, one a line");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline
