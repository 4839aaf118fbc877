// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadFuser: makes one surface of what several poses measured of a head. The first pose is the master: its
// frame, its instant, its expression.
//   hair      what lies beside the face and is unsure along the line of sight is half seen through: it goes;
//   bend      what another pose shows otherwise than the surfaces before it, because skin moved, is bent to
//             them: a smooth displacement along the normals, found where they overlap, at most so many
//             millimetres, none where they agree within the noise, so that there both are averaged;
//   choose    where two surfaces still disagree, the master's counts where it sees well, else the surest;
//   shape     the zero of the mean distance to what is left (implicit moving least squares; Kolluri 2008), by
//             marching cubes: one sheet, whoever measured it;
//   place     every vertex on the mean of the poses' own surfaces at it, weighted by certainty and fading to
//             the edge of each: no step where one ends;
//   close     cut the rims even, close holes, and lay these and what steps are left anew (rim.h).
// `sigma_mm` is made of the measurements' noise, the registration's and how far the skin was bent.
// Memory: the mesh in `output`; scratch 9 bytes a voxel of the head's box. Errors: PoorGeometry, Cancelled;
// throws std::bad_alloc. Thread: any; works on the pool, the result does not depend on its size.
#pragma once

#include <cstddef>
#include <span>

#include "pipeline/base/options.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/model/landmarks.h"

namespace relievo::pipeline {

struct FusedSurface {
  FaceMesh mesh;
  // Its vertices from here on close holes: where they lie, no photograph shows the head.
  std::size_t closing = 0;
};

struct HeadFuser {
  double voxel_mm = 0.8;
  double most_bend_mm = 1.5;
  double bend_width_mm = 6;  // sigma of its smoothing
  double still_mm = 0.05;    // less than this is noise
  double neck_mm = 112;      // below the tip of the nose

  void describe(auto&& field) {
    field("voxel_mm", voxel_mm, OptionRange{0.5, 3}, "side of a voxel, mm");
    field("most_bend_mm", most_bend_mm, OptionRange{0, 5},
          "a pose's skin is bent by this much at most to meet the poses before it, mm");
    field("bend_width_mm", bend_width_mm, OptionRange{2, 40}, "how smoothly, sigma in mm");
    field("still_mm", still_mm, OptionRange{0, 1},
          "what lies off by less than this is not bent but averaged, mm");
    field("neck_mm", neck_mm, OptionRange{60, 300}, "how far below the tip of the nose the head is cut, mm");
  }
  // `face`: the master's own mesh, of which is taken what lies between the lids, found by its `landmarks`,
  // and what was completed where no pose shows anything, but for crown and back of a head. Bends `poses`.
  Result<FusedSurface> fuse(std::span<HeadPose> poses, const Registration& registration, const FaceMesh& face,
                            const Landmarks& landmarks, StageContext& context) const;
};

// Skin that moved between the pictures: one after the other, next always the one that overlaps most with
// those that are done, the poses are bent along their normals to these; the first never moves. A sigma grows
// by a share of how far the skin around was bent. `skull_stays`: behind the temples, where no other pose
// shows it, skin is held where it is, as it hangs on the skull and does not move as the face beside it; not
// where the poses' calibrations differ, for then it may be off as a whole. Memory: scratch. Throws
// std::bad_alloc.
void bend_to_master(std::span<HeadPose> poses, const Registration& registration, const HeadFuser& limits,
                    bool skull_stays, StageContext& context);

}  // namespace relievo::pipeline
