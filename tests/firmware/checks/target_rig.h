// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulated rig as the optical self-test sees it. Tests may lie about the targets: what is
// photographed is `true_targets`, what is certified lies in the shot.
#pragma once

#include <optional>

#include "firmware/checks/optical_check.h"
#include "hal/sim/target/target_photo.h"

namespace relievo::firmware {

inline constexpr double kHalfScale = 0.5;  // of the pixels, for light tests

struct TargetRig {
  hal::sim::RigOptions rig;
  std::optional<OpticalTargets> true_targets;

  hal::sim::TargetPhotoOptions options(const TargetShot& shot) const {
    hal::sim::TargetPhotoOptions o;
    o.rig = rig;
    o.rig.width_px = static_cast<int>(rig.width_px * shot.scale);
    o.rig.height_px = static_cast<int>(rig.height_px * shot.scale);
    o.rig.seed = o.seed = shot.seed;
    return o;
  }

  Result<TargetPictures> operator()(const TargetShot& shot) const {
    const OpticalTargets& t = true_targets ? *true_targets : shot.targets;
    const TargetPlace& p = shot.place;
    const hal::sim::ArtefactPlace place{p.right_mm,  p.down_mm, p.distance_mm,
                                        p.pitch_deg, p.yaw_deg, p.roll_deg};
    const auto take = [&]() -> Result<hal::sim::PicturePair> {
      if (shot.kind == TargetKind::Board)
        return photograph_board(options(shot), {t.board_columns, t.board_rows, t.square_mm}, shot.number,
                                shot.count);
      if (shot.kind == TargetKind::Dumbbell)
        return photograph_dumbbell(
            options(shot), {t.sphere_diameter_mm, t.sphere_spacing_mm, t.rod_diameter_mm / 2, shot.seed},
            place);
      return photograph_plate(options(shot), {t.plate_width_mm, t.plate_height_mm, shot.seed}, place);
    };
    RELIEVO_TRY_ASSIGN(auto pair, take());
    return TargetPictures{std::move(pair.left), std::move(pair.right)};
  }
};

}  // namespace relievo::firmware
