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
#include "pipeline/match/keypoint_selector.h"

namespace relievo::pipeline {

struct FileSelectorOptions {
  TextFile file;
};

template <typename Field>
void describe(FileSelectorOptions& o, Field&& field) {
  field("path", o.file, OptionRange{0, 0},
        "text file of keypoints: x,y in pixels of the left rectified view, one a line");
}

class FileSelector final : public KeypointSelector {
 public:
  explicit FileSelector(const FileSelectorOptions& options) : options_(options) {}
  std::string_view name() const override { return "file-points"; }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const override;

 private:
  FileSelectorOptions options_;
};

}  // namespace relievo::pipeline
