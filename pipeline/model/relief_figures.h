// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReliefFigures: how the middle of a face differs from a sheet of paper, flat or bent.
#pragma once

namespace relievo::pipeline {

struct ReliefFigures {
  double covered = 0;         // share of the disc around the middle of the face that was measured
  double sigma_mm = 0;        // stated for it, median
  double off_plane_mm = 0;    // rms of the nearest three quarters off the best plane
  double off_sheet_mm = 0;    // off the best sheet, bent along any one direction
  double sheet_range_mm = 0;  // of the same, averaged over discs of 8 mm radius: 2nd to 98th percentile
  double curvature_sr = 0;    // integral of |Gaussian curvature|, steradians
};

}  // namespace relievo::pipeline
