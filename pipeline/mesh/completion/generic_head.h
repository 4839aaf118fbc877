// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What heads usually look like: radii as a mean and kHeadModes ways in which people differ from it, each
// scaled to one standard deviation (principal components; Blanz and Vetter, A morphable model for the
// synthesis of 3D faces, 1999, without their correspondences: a radius is where it is). Two sets of radii:
// of the face about the head's upright axis (UnrolledHead), and of the whole head, its neck cut off, at
// the nodes of a globe (Globe) about a point within it; its modes are what goes with those of the face.
// Learned from 300 heads of hal/sim, whose measures follow Farkas, each laid into the frame that
// find_head_frame() found on it. generic_head.bin holds them and is part of the program;
// generic_head.bin.license says how it is made. Millimetres, head frame. Thread: any.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/arena.h"
#include "hal/base/result.h"
#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

inline constexpr int kHeadColumns = 51;  // arcs from -kHalfArc to kHalfArc
inline constexpr int kHeadRows = 39;     // heights from -kBelow to kAbove
inline constexpr int kGlobeTimes = 4;    // the globe's triangles were quartered
inline constexpr int kGlobeNodes = 2562;
inline constexpr Vec3d kGlobeCentre{0, 10, -100};
inline constexpr int kHeadModes = 24;
inline constexpr double kHeadMeanUnit = 0.01;  // mm a count
inline constexpr double kHeadModeUnit = 0.001;

// How generic_head.bin begins; its numbers are little-endian. Counts of 16 bits follow: mean, modes and left
// of the face, then of the whole head.
struct GenericHeadHeader {
  std::array<char, 8> magic;
  std::int32_t columns, rows, nodes, modes;
  bool operator==(const GenericHeadHeader&) const = default;
};
static_assert(std::endian::native == std::endian::little);
inline constexpr GenericHeadHeader kGenericHeadHeader{
    {'R', 'e', 'l', 'H', 'e', 'a', 'd', '1'}, kHeadColumns, kHeadRows, kGlobeNodes, kHeadModes};

// One set of radii.
struct HeadRadii {
  std::span<const std::int16_t> mean;  // kHeadMeanUnit
  std::span<const std::int16_t> mode;  // one after the other; kHeadModeUnit
  std::span<const std::int16_t> left;  // rms of what no mode shows, of heads kept apart; kHeadMeanUnit
};

struct GenericHead {
  HeadRadii face;   // rows of kHeadColumns, from the lowest
  HeadRadii globe;  // kGlobeNodes
};

// Points into `file`. Error: InvalidInput where it is none.
Result<GenericHead> read_generic_head(std::span<const std::byte> file);

// The program's own.
std::span<const std::byte> generic_head_file();

// A head laid flat: radii about its upright axis, which stands kAxisBehind behind the tip of the nose, over
// arc and height.
inline constexpr double kAxisBehind = 90;  // mm behind the tip: the head's upright axis
inline constexpr double kArcRadius = 80;   // mm: turns angles about it into lengths
inline constexpr double kHalfArc = 125;    // to the ears
inline constexpr double kBelow = 95, kAbove = 95;

// The surface with each vertex where `place` has it, without anything else. Memory: scratch.
template <typename Place>
FaceMesh laid_flat(const FaceMesh& mesh, Arena& scratch, Place&& place) {
  FaceMesh flat(&scratch);
  flat.vertices_mm.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) flat.vertices_mm.push_back(place(v));
  flat.triangles = mesh.triangles;
  return flat;
}

// Of arc, height and radius about the head's axis the place in the head's frame.
Vec3d rolled(double arc, double y, double radius);

// `own` holds what was measured, `added` what a completion proposes. Memory: scratch.
struct UnrolledHead {
  UnrolledHead(const FaceMesh& mesh, const RigidTransform& head_from_camera, double cell_mm, Arena& scratch);

  // Takes as added what the other side shows, wherever nothing was measured; moved by what the two differ
  // where both are known, relaxed into the new part (Laplace), so that no step is left at the seam.
  void add_other_side(Arena& scratch);

  bool has_own(int c, int r) const { return !std::isnan(own.z(c, r)); }

  double cell_mm;
  FaceMesh flat;  // the surface, unrolled
  FaceRelief own, added;
  FaceRelief away;  // mm along the cells, of each from what was measured; of the other side alone
};

// The head of the family that fits best what was measured of one: ridge regression of the modes' weights on
// radii, rounds of Huber's weights against hair, a tongue, a hand. `misfit_mm`: what a person differs by from
// all that the family can be, one standard deviation. Throws std::bad_alloc.

// Takes its radii as added, measured or not; NaN below the jaw.
void fit_generic_face(UnrolledHead& head, double misfit_mm);

// Radii and their sigmas at the nodes of the generic head's globe: the sigma is the posterior's, with what
// the family cannot show.
std::array<std::pmr::vector<double>, 2> fit_generic_globe(const UnrolledHead& head, double misfit_mm,
                                                          std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
