// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/file_selector.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/file/number_lines.h"
#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {
Result<Keypoints> FileSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels_of_left(pair));
  if (context.stop()) return Error{Errc::Cancelled, "the choice of keypoints was stopped"};
  if (file.path.empty())
    return Error{Errc::NotFound, "no file of keypoints is named: --set file-points.path=FILE"}.at(
        "file-points.path");
  if (file.text == nullptr)
    return Error{Errc::NotFound, "this file of keypoints could not be read; check its name"}.at(file.path);
  const Selectable selectable(pair, &context.scratch);
  RELIEVO_TRY(check_selectable(selectable));
  Keypoints keypoints(&context.output);
  keypoints.points.reserve(lines_of(*file.text));
  NumberLines lines(*file.text, 2);
  NumberLine line;
  bool any = false;
  while (lines.next(line)) {
    any = true;
    const auto refused = [&](Literal what) {
      return Error{Errc::InvalidInput, what}.at(line_name(file.path, line.number));
    };
    if (line.count < 2) return refused("is not a line of numbers with commas or blanks between them");
    const double x = line.value[0], y = line.value[1];
    if (!(x >= 0 && y >= 0 && x <= pair.width_px - 1 && y <= pair.height_px - 1))
      return refused("lies outside of the left rectified view; x and y are its pixels, from 0");
    if (selectable(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), 0))
      keypoints.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
  }
  if (!any) return Error{Errc::InvalidInput, "holds no line of numbers"}.at(file.path);
  std::sort(keypoints.points.begin(), keypoints.points.end(), [](const Keypoint& a, const Keypoint& b) {
    return a.at_px.y != b.at_px.y ? a.at_px.y < b.at_px.y : a.at_px.x < b.at_px.x;
  });
  const auto same = [](const Keypoint& a, const Keypoint& b) {
    return a.at_px.x == b.at_px.x && a.at_px.y == b.at_px.y;
  };
  keypoints.points.erase(std::unique(keypoints.points.begin(), keypoints.points.end(), same),
                         keypoints.points.end());
  if (keypoints.points.empty())
    return Error{Errc::NoFace, "no keypoint of the file lies in the face region"}.at(file.path);
  return keypoints;
}

}  // namespace relievo::pipeline
