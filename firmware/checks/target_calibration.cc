// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/checks/target_calibration.h"

#include <string>

#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::firmware {
namespace {

// No board is a finding, anything else an error.
Result<pipeline::BoardCorners> look(const hal::Picture& picture, const pipeline::BoardPattern& pattern) {
  auto corners = pipeline::find_board(picture.view(), pattern);
  if (!corners && corners.error().code == Errc::NotFound) return pipeline::BoardCorners{};
  return corners;
}

}  // namespace

Result<pipeline::CalibratorOutput> calibrate_on_boards(const Photograph& photograph, const TargetShot& series,
                                                       int boards, const std::atomic<bool>& cancelled,
                                                       const std::function<void()>& each) {
  pipeline::CalibratorInput input;
  input.pattern = {series.targets.board_columns, series.targets.board_rows, series.targets.square_mm};
  TargetShot shot = series;
  shot.kind = TargetKind::Board;
  shot.count = boards;
  for (shot.number = 0; shot.number < boards; ++shot.number) {
    if (cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
    RELIEVO_TRY_ASSIGN(const TargetPictures pictures, photograph(shot));
    input.width_px = pictures.left.width_px;
    input.height_px = pictures.left.height_px;
    pipeline::BoardView& view = input.views.emplace_back();
    view.name = std::to_string(shot.number);
    RELIEVO_TRY_ASSIGN(view.left, look(pictures.left, input.pattern));
    RELIEVO_TRY_ASSIGN(view.right, look(pictures.right, input.pattern));
    each();
  }
  RELIEVO_TRY_ASSIGN(auto output, pipeline::calibrate(input));
  if (output.quality.verdict == pipeline::CalibrationVerdict::Refuse)
    return Error{Errc::PoorGeometry,
                 "the calibration on the boards is refused: there is nothing to measure targets with"};
  return output;
}

}  // namespace relievo::firmware
