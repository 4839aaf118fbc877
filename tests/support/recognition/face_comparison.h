// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much two measured faces differ in shape: the rigid parts are laid on each other (trimmed iterative
// closest points, point to plane, both ways at once: Chen, Medioni 1992; Chetverikov, Svirko, Stepanov,
// Krsek, ICPR 2002), started from the head frames, and what is left between them is the difference. Plain:
// nothing is learned and nothing is invented where one of them was not measured.
//
//   the same head twice:  tenths of a millimetre, what the measurements' noise leaves
//   two people:           mostly more than half a millimetre (figures: tests/bench/recognition/README.md)
//
// Errors: PoorGeometry (too little surface, or too little that both show). Throws std::bad_alloc.
// Thread: any number at once on the same faces.
#pragma once

#include "hal/base/result.h"
#include "tests/support/recognition/nearest_points.h"
#include "tests/support/recognition/rigid_face.h"

namespace relievo::pipeline {

struct FaceDifference {
  double rms_mm = 0;        // trimmed, symmetric: of the distances along the normal, a to b and b to a
  double shared = 0;        // share of the one face's points that meet the other: the smaller of both ways
  RigidTransform b_from_a;  // how the head frames had to be moved
};

// A face ready to be compared with many others.
class ComparableFace {
 public:
  // Errors: PoorGeometry (fewer than 400 points).
  static Result<ComparableFace> make(RigidFace face);
  const RigidFace& face() const { return face_; }
  const NearestPoints& tree() const { return tree_; }

 private:
  ComparableFace(RigidFace face, NearestPoints tree) : face_(std::move(face)), tree_(std::move(tree)) {}
  RigidFace face_;
  NearestPoints tree_;
};

// Symmetric: compare(a, b) is compare(b, a) but for rounding.
Result<FaceDifference> compare_faces(const ComparableFace& a, const ComparableFace& b);

}  // namespace relievo::pipeline
