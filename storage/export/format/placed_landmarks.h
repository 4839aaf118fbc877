// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model's landmarks as its files carry them: those that were found, in the frame of the export,
// millimetres.
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

struct PlacedLandmark {
  std::string_view name;
  pipeline::Vec3d at_mm;
  double sigma_mm = 0;
};

inline std::vector<PlacedLandmark> placed_landmarks(const ExportMesh& mesh) {
  std::vector<PlacedLandmark> placed;
  for (std::size_t k = 0; k < pipeline::kLandmarkCount; ++k) {
    const pipeline::Landmark& l = mesh.model.landmarks[k];
    const pipeline::Vec3d at{l.at_mm.x, l.at_mm.y, l.at_mm.z};
    if (!l.found || !std::isfinite(at.x + at.y + at.z) ||
        std::abs(at.x) + std::abs(at.y) + std::abs(at.z) > 1e6 || !(l.sigma_mm >= 0 && l.sigma_mm < 1e6F))
      continue;
    placed.push_back({word(static_cast<pipeline::LandmarkName>(k)),
                      mesh.frame == ExportFrame::Head ? apply(mesh.model.head_from_camera, at) : at,
                      static_cast<double>(l.sigma_mm)});
  }
  return placed;
}

}  // namespace relievo::storage
