// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceRelief: the measured surface as heights over a plane of the head, z(x, y) on square cells; NaN
// where nothing was measured. Where surface lies behind surface the foremost counts. Millimetres, in
// the frame it is asked for. Memory: the arena given. Thread: any.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

struct ReliefBox {
  double left_mm = 0, right_mm = 0, bottom_mm = 0, top_mm = 0;  // x and y of the outermost cells' centres
  double cell_mm = 1;
};

class FaceRelief {
 public:
  FaceRelief(const ReliefBox& box, std::pmr::memory_resource* memory);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double x_mm(int column) const { return box_.left_mm + column * box_.cell_mm; }
  double y_mm(int row) const { return box_.bottom_mm + row * box_.cell_mm; }
  float& z(int column, int row) { return z_[index(column, row)]; }
  float z(int column, int row) const { return z_[index(column, row)]; }
  bool inside(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  // Between cells; NaN where one of the four around has nothing.
  double at(double x_mm, double y_mm) const;

  // Lays the triangles whose three corners were measured, or all, into it. The box's left is its right,
  // mirrored.
  void add(const FaceMesh& mesh, const RigidTransform& frame_from_mesh, bool completed_too = false);
  // Both at once, on the pool, for who lays a mesh many times: what was measured into `measured`, all of it
  // into `shown`, two reliefs over one box. The same as add() twice.
  static void add_both(const FaceMesh& mesh, const RigidTransform& frame_from_mesh, FaceRelief& measured,
                       FaceRelief& shown, StageContext& context);
  // Both halves become their mean, or the one there is.
  void symmetrise();
  // A Gaussian over what is there; cells with nothing stay so.
  void smooth(double sigma_mm, std::pmr::memory_resource* scratch);

 private:
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }
  // In cells; z in mm.
  Vec3f in_cells(const Vec3f& vertex, const RigidTransform& frame_from_mesh) const;
  void add_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c);
  void add_foremost(const FaceRelief& other);
  void smooth_along(bool rows, const std::pmr::vector<float>& kernel, std::pmr::vector<float>& line);

  ReliefBox box_;
  int columns_ = 0, rows_ = 0;
  std::pmr::vector<float> z_;
};

}  // namespace relievo::pipeline
