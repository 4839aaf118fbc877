// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A lighter level of detail of a finished, textured model, for a screen and for export: edges are collapsed
// in the order of what they cost in quadric error (collapse_edges). Vertices are a subset of the model's,
// with their normals, sigmas and colours; the border keeps its line, and vertices at seams of the texture
// stay, so that the same atlas fits. What it costs is measured afterwards, vertex by vertex, and kept below
// `max_error_mm` by simplifying less where need be; a model that cannot be kept below it comes back whole.
// Frame and units: the model's. Memory: `memory`. Thread: any.
#pragma once

#include <memory_resource>
#include <span>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// How far points lie from a surface of triangles: the exact distance to its nearest point, found through
// cells over the picture plane. Points and surface lie in front of the camera at the origin. Millimetres.
struct SurfaceDistance {
  double rms_mm = 0;
  double max_mm = 0;
};

// Zero for no points. Throws std::bad_alloc when `memory` is used up.
SurfaceDistance distance_to_surface(std::span<const Vec3f> points_mm, std::span<const Vec3f> vertices_mm,
                                    std::span<const Triangle> triangles, std::pmr::memory_resource* memory);

// Squared, of a point to a triangle.
double squared_distance_to_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c);

struct DetailOptions {
  int triangles = 40'000;     // as many as that, where the error allows it
  double max_error_mm = 0.5;  // of any vertex of the model to the lighter surface

  Result<void> check() const;
};

struct LighterModel {
  explicit LighterModel(std::pmr::memory_resource* memory) : model(memory) {}
  FaceModel model;
  double rms_error_mm = 0;  // of the model's vertices to the lighter surface
  double max_error_mm = 0;
};

// One that is light enough already comes back as it is. Errors: InvalidInput (options; a model that does not
// hang together). Throws std::bad_alloc when `memory` is used up.
Result<LighterModel> lighten(const FaceModel& model, const DetailOptions& options,
                             std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
