// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a face that neither talks nor smiles: nose, its root, brow, forehead and cheekbones, without
// the eyes' openings (regions as in Chang, Bowyer, Flynn: Multiple nose region matching for 3D face
// recognition under varying facial expression, PAMI 2006; Faltemier, Bowyer, Flynn, TIFS 2008). Heights over
// a lattice of 1.5 mm in the head frame, measured surface only, lightly smoothed (1.5 mm), with normals.
// Throws std::bad_alloc. Thread: any.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct RigidFace {
  explicit RigidFace(std::pmr::memory_resource* memory) : points_mm(memory), normals(memory), rim(memory) {}
  std::pmr::vector<Vec3f> points_mm;   // head frame
  std::pmr::vector<Vec3f> normals;     // one a point, unit length, out of the face
  std::pmr::vector<std::uint8_t> rim;  // one a point: 1 where the region or the measurement ends beside it
};

constexpr double kRigidFaceCellMm = 1.5;

// Whether a place of the head frame (tip of the nose at the origin, mm) belongs to the region: of an average
// face (Farkas 1994), with room for others.
bool in_rigid_region(double x_mm, double y_mm);

// `mesh` in the left camera's frame. Empty where nothing of the region was measured.
RigidFace rigid_face_of(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                        std::pmr::memory_resource* output, std::pmr::memory_resource* scratch);

}  // namespace relievo::pipeline
