// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What makes a face's surface of the lattice on which it was measured: closes gaps, trims the outline, closes
// the face, cuts it. All throw std::bad_alloc when the memory given is used up. Thread: any.
#pragma once

#include <atomic>
#include <memory_resource>
#include <optional>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/lattice_resampler.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

// Fills cells of a lattice that carry no surface, or half of one: nodes that no triangle holds are put
// where a thin plate through the surface around them has them (inside a gap it bridges, beyond an outline
// it goes on straight), become Node::Filled, with twice the sigma usual around them; then the cells are
// cut, but for those that would be steeper than `max_slope`.
//
// `wanted`: which; they must not touch the last column and row. `like`: empty, or on a head's chart the radii
// of another surface, mm, 0 where nothing is known of it: the plate bends as that does. Once `cancelled` is
// set, what is filled is not finished: the caller throws it away.
void fill_cells(PointLattice& lattice, const CellMask& wanted, float max_slope, std::span<const double> like,
                std::pmr::memory_resource* memory, const std::atomic<bool>* cancelled = nullptr);

// Closes gaps of a lattice's surface: holes, and cracks of any length, wherever they are narrow and both
// sides continue each other. What is narrow is decided by a closing with a disc (Serra 1982), then in
// millimetres of space from rim to rim; what continues, by the slope of the shortest bridge, which may
// leave the slopes on its two sides by little. An occlusion edge (the side of a nose, a nostril) fails
// and stays open, and so does whatever would be steeper than the surface may be.
//
// Closed cells are filled. Specks of surface smaller than the widest gap are taken for part of the gap;
// pinholes that noise leaves in a bridge are laid anew with what lies around them.
void close_gaps(PointLattice& lattice, const LatticeLimits& limits, MaskShaper& shaper,
                std::pmr::memory_resource* memory);

// The outline of a lattice's surface, found in four steps, the first three blind to holes inside, whose
// surroundings stay as they are:
//   the rim   surface that turns away from the camera and leads to the outside goes: the last rows before
//             the horizon are measured worst, and left standing they are a fringe of teeth and flags;
//   strips    whatever a disc of min_width_mm does not fit into goes (an opening; Serra 1982);
//   waves     the line of a cheek's steepest surface swings in and out: it is straightened (a Gaussian of
//             wave_mm over what is in). Bays are filled with what was measured there, where it continues
//             the surface, else with its smooth continuation (Node::Filled); tongues are cut;
//   nicks     a hole that stayed open a few millimetres from the outside (between strands of hair) goes with
//             what lies around it: the outline passes within it, in a bow no narrower than a disc of
//             min_width_mm's radius.
// Empties the cells beyond, fills bays; returns what lies inside, holes included.
CellMask trim_outline(PointLattice& lattice, const LatticeLimits& limits, MaskShaper& shaper,
                      std::pmr::memory_resource* memory);

// Cells whose surface, averaged over about 1.5 mm, is steeper than this tangent to the line of sight from a
// place.
CellMask steep_cells(const PointLattice& lattice, float max_slope, const Vec3f& from_mm,
                     std::pmr::memory_resource* memory);

// Of what was completed, to a ray from the chart's centre: tangent of 88 degrees.
inline constexpr float kSteepest = 28.6F;

// Closes a face on its head's chart (head_chart.h): everything within its outline that was not measured gets
// a surface that continues what was, as curved as the mirrored other side where that was measured. Beside a
// nose, under it, in corners of eyes and mouth, beyond what both cameras saw of a cheek. Measured surface
// stays where it is, but for the steep last two millimetres before a hole, what is most unsure below the tip
// of the nose, and a strip along the seam of a large completed part, which are laid anew.
//
// `seen`: the left view's lattice. None where no head is found in it. The face is in scratch. Error:
// Cancelled.
Result<std::optional<ShapedLattice>> close_face(const PointLattice& seen, const Vec3d& right_camera_mm,
                                                const LatticeLimits& limits, StageContext& context);

// Cuts a lattice's surface along smooth lines a fraction of a cell inside its edges: the share of surface
// around each node (a Gaussian) is a field, and triangles are cut where it falls to a level (marching
// triangles on the lattice). The outline is smoothed by more than the rims of holes, whose shape is the
// face's. Nodes closer to a line than a quarter of an edge are moved onto it, along the edge, so that no
// slivers arise (Labelle, Shewchuk 2007). Every vertex stays on an edge it was on.
//
// Triangles that the move would make steeper than `max_slope` are left out. A mesh of only vertices that a
// triangle uses, measured where both nodes of their edge are, with sigmas along the line of sight and without
// normals; in the lattice's frame.
FaceMesh cut_outline(const ShapedLattice& shaped, const LatticeLimits& limits, float max_slope,
                     std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
