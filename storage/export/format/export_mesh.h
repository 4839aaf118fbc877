// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ExportMesh: a face model as the writers want it: checked, in the frame asked for, millimetres.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/geometry.h"

namespace relievo::storage {

// Head: origin at the tip of the nose, x to the person's left, y up, z out of the face.
// Camera: the left camera before rectification, x right, y down, z forward.
enum class ExportFrame : std::uint8_t { Head, Camera };

struct ExportMesh {
  const pipeline::FaceModel& model;  // for what no frame changes: triangles, uv, texture, sigma
  ExportFrame frame;
  std::vector<pipeline::Vec3f> vertices_mm;
  std::vector<pipeline::Vec3f> normals;              // unit length, always
  std::vector<std::array<std::uint8_t, 3>> colours;  // one a vertex; white where the model has none
  std::string_view version{};                        // of the program, for files that can say it

  bool textured() const { return !model.texture.uv.empty(); }
};

// InvalidInput: lengths that do not fit together, indices out of range, numbers that are not finite.
// May throw std::bad_alloc. `model` must outlive the result.
Result<ExportMesh> make_export_mesh(const pipeline::FaceModel& model, ExportFrame frame);

// A model's landmarks as its files carry them: those that were found, in the frame of the export,
// millimetres.
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
                      double(l.sigma_mm)});
  }
  return placed;
}

}  // namespace relievo::storage
