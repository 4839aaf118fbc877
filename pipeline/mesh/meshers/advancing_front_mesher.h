// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// AdvancingFrontMesher (`advancing-front`): a surface grown over the 3-D Delaunay triangulation of the
// points, always by the most plausible triangle (Cohen-Steiner, Da 2004; CGAL). Takes any cloud; its vertices
// are the measured points. Frame: the left camera's, millimetres. Memory: the mesh in `output`, the rest in
// `scratch`, but for CGAL's own structure, which comes from the heap (about 700 bytes a point). Errors:
// PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled. Thread: any; keeps no state.
#pragma once

#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

struct AdvancingFrontMesherOptions {
  int max_points = 160'000;   // more are thinned evenly
  double max_edge_mm = 5;     // longest edge
  double max_edge_ratio = 6;  // longest edge, in usual distances between neighbours
  FinishOptions finish;

  Result<void> check() const;
};

template <typename Field>
void describe(AdvancingFrontMesherOptions& o, Field&& field) {
  field("max_points", o.max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
  field("max_edge_mm", o.max_edge_mm, OptionRange{0.1, 100}, "longest edge, mm");
  field("max_edge_ratio", o.max_edge_ratio, OptionRange{1.5, 100},
        "longest edge, in usual distances between neighbours");
  describe_finish(o.finish, field);
}

class AdvancingFrontMesher final : public Mesher {
 public:
  explicit AdvancingFrontMesher(const AdvancingFrontMesherOptions& options) : options_(options) {}
  std::string_view name() const override { return "advancing-front"; }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const override;

 private:
  AdvancingFrontMesherOptions options_;
};

}  // namespace relievo::pipeline
