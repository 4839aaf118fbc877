// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/file_selector.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/file/number_table.h"
#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kMostPoints = 4'000'000;  // more than a picture has pixels

}  // namespace

Result<void> FileSelectorOptions::check() const { return {}; }

Result<Keypoints> FileSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels_of_left(pair));
  if (context.stop()) return Error{Errc::Cancelled, "the choice of keypoints was stopped"};
  if (options_.path.empty())
    return Error{Errc::InvalidInput, "no file of keypoints is named: --set file-points.path=FILE"}.at(
        "file-points.path");
  RELIEVO_TRY_ASSIGN(const NumberTable table,
                     read_number_table(options_.path, 2, kMostPoints, context.scratch));
  const Selectable selectable(pair, &context.scratch);
  RELIEVO_TRY(check_selectable(selectable));
  Keypoints keypoints(&context.output);
  keypoints.points.reserve(table.rows());
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const double x = table.at(k, 0);
    const double y = table.at(k, 1);
    if (!(x >= 0 && y >= 0 && x <= pair.width_px - 1 && y <= pair.height_px - 1))
      return Error{Errc::InvalidInput,
                   "lies outside of the left rectified view; x and y are its pixels, from 0"}
          .at(table.place(k));
    if (selectable(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), 0))
      keypoints.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
  }
  std::sort(keypoints.points.begin(), keypoints.points.end(), [](const Keypoint& a, const Keypoint& b) {
    return a.at_px.y != b.at_px.y ? a.at_px.y < b.at_px.y : a.at_px.x < b.at_px.x;
  });
  const auto same = [](const Keypoint& a, const Keypoint& b) {
    return a.at_px.x == b.at_px.x && a.at_px.y == b.at_px.y;
  };
  keypoints.points.erase(std::unique(keypoints.points.begin(), keypoints.points.end(), same),
                         keypoints.points.end());
  if (keypoints.points.empty())
    return Error{Errc::NoFace, "no keypoint of the file lies in the face region"}.at(options_.path);
  return keypoints;
}

}  // namespace relievo::pipeline
