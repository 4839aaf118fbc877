// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GridMesher (`grid`, the default): joins neighbours of the pixel lattice on which a dense matcher
// measured, a face on its head's chart (head_chart.h). Needs PointCloud::lattice_step_px > 0.
//
// Promises: one connected component (the largest), every edge in at most two triangles, one fan a vertex,
// counter-clockwise seen from the cameras, no measured triangle steeper than max_incidence_deg to the line of
// sight of that view, a straightened boundary without fringe, no angle below kSmallestAngleDeg where noise
// allows it, never more than max_triangles. Where the cloud says from which views it comes and holds a head,
// the face is closed and cut to its outline (surface_shaping.h): what was completed has measured = 0 and may
// turn away from the cameras. Elsewhere small holes are closed with a thin-plate surface, larger ones stay
// open. So is marked what is less certain than measured_sigma_mm (a chin that moved between the exposures).
// sigma_mm is perpendicular to the surface: the line of sight's sigma times the cosine of the angle of
// incidence. Frame: the left camera's, millimetres. Memory: arenas only. Errors: Unsupported (scattered
// points), PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled. Thread: any; keeps no state.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

struct GridMesher {
  int max_triangles = 470'000;  // the lattice is resampled to use them, and never more
  double finest_cells = 0.7;    // but to no finer than so many cells of the points' own lattice
  double edge_cells = 1.4;  // where they are not enough for that: the outermost cells, in those of the middle
  double max_incidence_deg = 77;    // steepest triangle, between its normal and the line of sight
  double step_sigmas = 4;           // a neighbour's depth may leave the local slope by this many sigmas ...
  double step_slope_ratio = 3;      // ... and by this many times the slope on either side
  double min_step_mm = 0.5;         // smaller steps are never taken for an edge of something in front
  double max_hole_mm = 12;          // holes and cracks up to this wide are closed; 0 leaves all open
  double gap_bend_deg = 30;         // a closed gap's slope may leave that of both its sides so far
  double max_rim_deg = 70;          // steepest surface that leads to the outside; 90 keeps all
  double min_width_mm = 9;          // narrower strips along the outline are cut off; 0 keeps them
  double outline_wave_mm = 8;       // sigma of its straightening, by give and take; 0 leaves its waves
  double outline_smoothing_mm = 3;  // sigma of the outline's smoothing; 0 leaves it on the lattice
  double rim_smoothing_mm = 1.5;    // the same, of the rims of open holes
  int normal_passes = 1;            // how often normals are averaged over the neighbours; 0 to 16
  double measured_sigma_mm = kMeasuredSigmaMm;
  double min_area_mm2 = 6000;  // less surface than this is no face: a third of a child's

  void describe(auto&& field) {
    field("max_triangles", max_triangles, OptionRange{1000, 10'000'000},
          "the lattice is resampled to use so many triangles, and never more");
    field("finest_cells", finest_cells, OptionRange{0.5, 4},
          "the resampled lattice is no finer than so many cells of the points' own");
    field("edge_cells", edge_cells, OptionRange{1, 4},
          "how many times wider the outermost cells may be where triangles are scarce");
    field("max_incidence_deg", max_incidence_deg, OptionRange{30, 89},
          "steepest triangle, between its normal and the line of sight, degrees");
    field("step_sigmas", step_sigmas, OptionRange{0, 100},
          "a neighbour's depth may leave the local slope by this many sigmas");
    field("step_slope_ratio", step_slope_ratio, OptionRange{1, 100},
          "and by this many times the slope on either side");
    field("min_step_mm", min_step_mm, OptionRange{0, 100},
          "smaller steps are never an edge of something in front, mm");
    field("max_hole_mm", max_hole_mm, OptionRange{0, 50}, "holes and cracks up to this wide are closed, mm");
    field("gap_bend_deg", gap_bend_deg, OptionRange{0, 80},
          "how far a closed gap's slope may leave that of both its sides, degrees");
    field("max_rim_deg", max_rim_deg, OptionRange{30, 90},
          "steepest surface that leads to the outside, between its normal and the line of sight, degrees");
    field("min_width_mm", min_width_mm, OptionRange{0, 50},
          "narrower strips along the outline are cut off, mm");
    field("outline_wave_mm", outline_wave_mm, OptionRange{0, 30},
          "how far waves of the outline are straightened, sigma in mm");
    field("outline_smoothing_mm", outline_smoothing_mm, OptionRange{0, 10},
          "how far the outline is smoothed, sigma in mm");
    field("rim_smoothing_mm", rim_smoothing_mm, OptionRange{0, 10},
          "how far the rims of open holes are smoothed, sigma in mm");
    field("normal_passes", normal_passes, OptionRange{0, 16},
          "how often normals are averaged over the neighbours");
    field("measured_sigma_mm", measured_sigma_mm, OptionRange{0.01, 1000},
          "surface less certain than this is shown, but not as measured, mm");
    field("min_area_mm2", min_area_mm2, OptionRange{0, 1e6}, "less surface than this is no face, square mm");
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline
