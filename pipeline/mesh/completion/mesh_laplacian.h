// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a value at the vertices of a mesh bends: the Laplacian by cotangents (Pinkall, Polthier, Computing
// discrete minimal surfaces and their conjugates, 1993), per area, so that triangles of uneven size and shape
// are no bend. Thread: any. Throws std::bad_alloc.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

struct MeshLaplacian {
  struct Neighbour {
    std::uint32_t vertex;
    double weight;  // of its value less the vertex' own
  };
  std::vector<std::vector<Neighbour>> neighbours;
  std::vector<double> area;  // a third of the triangles around a vertex
};

// `at`: where the vertices lie, any unit. Angles count as at least 3 and at most 177 degrees.
MeshLaplacian laplacian_of(std::span<const Eigen::Vector3d> at, std::span<const Triangle> triangles);

// Lays the vertices with `free` 1 anew so that the surface bends as little as it can (a thin plate) and goes
// on from the others, which stay, without a crease. With a tension it also stretches as little as it can:
// what is wider than `tension_mm` does not bulge, and no vertex of a fold, whose cotangents cancel, flies off
// as a needle; 0 for none. A vertex of no triangle stays; of what hangs together one vertex must not be free.
// Throws std::runtime_error where the equations have no solution.
void fair(std::span<Eigen::Vector3d> at, std::span<const Triangle> triangles, std::span<const char> free,
          double tension_mm = 0);

}  // namespace relievo::pipeline
