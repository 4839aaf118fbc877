// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is it a face, or a picture of one? Paper and screens, however they are held, are sheets: they bend without
// stretching. A face is no sheet, and by so much that no accuracy has to be reached for: its nose stands
// 15 mm and more before anything that can be rolled over its cheeks. Two figures of its middle, which know
// nothing of each other, must both be a face's:
//   off_sheet_mm   how far it lies off the nearest sheet (below), root mean square of the nearest three
//                  quarters: a lamp that glossy paper mirrors lies behind or before it, and does not count.
//                  A sheet: the noise. A face: 1.5 to 2.5 mm, without its nose.
//   curvature_sr   how much it curves both ways at once: the integral of |Gaussian curvature|, which bending
//                  cannot change (Gauss 1827: it is that of the flat sheet, none). A face: 5 to 13 sr.
// Masks have a face's relief: they are beyond this check.
// Memory: scratch only. Thread: any. Deterministic, whatever the number of threads.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "pipeline/base/options.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/relief.h"

namespace relievo::pipeline {

struct ReliefOptions {
  double least_off_sheet_mm = 1.2;  // two thirds of a flat face's
  double least_curvature_sr = 2.5;  // between pictures, with their noise, and half hidden faces
  double least_sigmas = 1.5;        // off_sheet_mm over the stated sigma: noise alone makes 0.55

  void describe(auto&& field) {
    field("least_off_sheet_mm", least_off_sheet_mm, OptionRange{0, 100},
          "rms by which a face leaves the nearest bent sheet at least, mm");
    field("least_curvature_sr", least_curvature_sr, OptionRange{0, 100},
          "what the middle of a face curves both ways at once at least, steradians");
    field("least_sigmas", least_sigmas, OptionRange{0, 100}, "the same rms at least, times the stated sigma");
  }
};

// Of the measured surface within 60 mm of the middle of the face; of the whole surface's middle where no face
// was looked for. All 0 where too little was measured there to tell. Errors: Cancelled.
Result<ReliefFigures> measure_relief(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context);

// Unjudged: too little was measured, or its noise could hide what a face has. Then nobody is refused for a
// picture, and nobody is told to be a face.
enum class ReliefVerdict : std::uint8_t { Face, Picture, Unjudged };
ReliefVerdict judge(const ReliefFigures& relief, const ReliefOptions& options);
// For the person, with figures for the technician as where(). Picture: NoFace; Unjudged: PoorGeometry.
Error error_of(ReliefVerdict verdict, const ReliefFigures& relief, const ReliefOptions& options);
// Why an assembled model is not known to be a face, by its figures and landmarks; none where it is, or where
// nobody asked. Also of a model that was read from a file.
std::optional<Error> why_unjudged(const FaceModel& model, const std::optional<ReliefOptions>& asked);

// The middle of a face as heights over its own mean plane, on square cells: every part of the surface
// counts by its area, however densely it was measured. Frame: origin on the plane, x across the pictures
// as far as the plane allows, y down, height towards the cameras; mm.
inline constexpr double kReliefRadiusMm = 60;  // eyes, nose and mouth of any face
inline constexpr double kReliefCellMm = 3;

struct HeightCell {
  int row = 0;
  double x_mm = 0, y_mm = 0;  // mean place of what fell into it
  double height_mm = 0;       // mean
  double sigma_mm = 0;        // mean of the stated sigmas: errors of neighbours hang together
};
using HeightCells = std::pmr::vector<HeightCell>;  // row by row; few where little was measured

// Measured surface within the radius around the middle of the face, as the pair saw it.
HeightCells make_height_cells(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context);

// The sheet of paper that comes closest to a surface. Paper bends without stretching: straight lines stay
// in it (a developable surface; do Carmo 1976, 3-5). Held by two sides these lines are parallel (a general
// cylinder: any profile, not only a circle) or meet in one point (a general cone). Seen over a plane
// both are one linear model: where lines meet at distance 1/k along t,
//   height(s, t) = c t + (1 - k t) g(s / (1 - k t)),  k = 0: the cylinder,
// g a cubic spline. Direction and k are searched, c and g follow by least absolute deviations (softened;
// iterated weights, Huber 1981), so that a mirrored lamp or a stray patch moves the sheet little.
// A plane is the sheet whose g is straight.
//
// How far each cell lies off the sheet, perpendicular, + before it. At least 30 cells. Errors: Cancelled.
Result<std::pmr::vector<double>> off_sheet_mm(const HeightCells& cells, StageContext& context);
std::pmr::vector<double> off_plane_mm(const HeightCells& cells, StageContext& context);

}  // namespace relievo::pipeline
