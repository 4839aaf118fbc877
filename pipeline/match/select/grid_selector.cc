// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/grid_selector.h"

#include <string>

#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {
namespace {

// Its last pixel; `length` 0 reaches to the view's edge.
int last_of(int first, int length, int view) { return length == 0 ? view - 1 : first + length - 1; }

}  // namespace

Result<Keypoints> GridSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels_of_left(pair));
  if (context.stop()) return Error{Errc::Cancelled, "the choice of keypoints was stopped"};
  const LatticeArea area{left_px, top_px, last_of(left_px, width_px, pair.width_px),
                         last_of(top_px, height_px, pair.height_px)};
  if (area.left > area.right || area.top > area.bottom || area.right >= pair.width_px ||
      area.bottom >= pair.height_px)
    return Error{
        Errc::InvalidInput,
        "the rectangle leaves the left rectified view, whose size is in brackets: give a smaller one"}
        .at("grid-points (" + std::to_string(pair.width_px) + " x " + std::to_string(pair.height_px) + ")");
  auto chosen = lattice_keypoints(pair, step_px, area, context);
  const bool part = left_px + top_px + width_px + height_px > 0;
  if (part && !chosen && chosen.error().code == Errc::NoFace)
    return Error{
        Errc::NoFace,
        "no place of the rectangle lies in the face region: choose another one, or take the whole view (--region all)"}
        .at("grid-points");
  return chosen;
}

}  // namespace relievo::pipeline
