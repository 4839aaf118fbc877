// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/face_relief.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr int kParts = 4;  // of a mesh, laid side by side

}  // namespace

FaceRelief::FaceRelief(const ReliefBox& box, std::pmr::memory_resource* memory) : box_(box), z_(memory) {
  columns_ = int(std::lround((box.right_mm - box.left_mm) / box.cell_mm)) + 1;
  rows_ = int(std::lround((box.top_mm - box.bottom_mm) / box.cell_mm)) + 1;
  z_.assign(std::size_t(columns_) * std::size_t(rows_), kNothing);
}

double FaceRelief::at(double x_mm, double y_mm) const {
  const double c = (x_mm - box_.left_mm) / box_.cell_mm;
  const double r = (y_mm - box_.bottom_mm) / box_.cell_mm;
  if (!(c >= 0 && r >= 0 && c <= columns_ - 1 && r <= rows_ - 1))
    return std::numeric_limits<double>::quiet_NaN();
  const int c0 = std::min(int(c), columns_ - 2);
  const int r0 = std::min(int(r), rows_ - 2);
  const double u = c - c0;
  const double v = r - r0;
  const auto value = [&](int dc, int dr) { return double(z(c0 + dc, r0 + dr)); };
  return (1 - v) * ((1 - u) * value(0, 0) + u * value(1, 0)) + v * ((1 - u) * value(0, 1) + u * value(1, 1));
}

Vec3f FaceRelief::in_cells(const Vec3f& vertex, const RigidTransform& frame_from_mesh) const {
  const Vec3d p = apply(frame_from_mesh, wide(vertex));
  return {float((p.x - box_.left_mm) / box_.cell_mm), float((p.y - box_.bottom_mm) / box_.cell_mm),
          float(p.z)};
}

void FaceRelief::add_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  if (a.x < -20 || a.y < -20 || a.x > float(columns_ + 20) || a.y > float(rows_ + 20)) return;
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(area) > 1e-9F)) return;
  const int from_row = std::max(0, int(std::ceil(std::min({a.y, b.y, c.y}))));
  const int to_row = std::min(rows_ - 1, int(std::floor(std::max({a.y, b.y, c.y}))));
  const int from_column = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}))));
  const int to_column = std::min(columns_ - 1, int(std::floor(std::max({a.x, b.x, c.x}))));
  for (int row = from_row; row <= to_row; ++row)
    for (int column = from_column; column <= to_column; ++column) {
      const float dx = float(column) - a.x;
      const float dy = float(row) - a.y;
      const float v = (dx * (c.y - a.y) - dy * (c.x - a.x)) / area;
      const float w = (dy * (b.x - a.x) - dx * (b.y - a.y)) / area;
      if (v < 0 || w < 0 || v + w > 1) continue;
      const float height = a.z + v * (b.z - a.z) + w * (c.z - a.z);
      float& cell = z(column, row);
      if (!(cell >= height)) cell = height;
    }
}

void FaceRelief::add(const FaceMesh& mesh, const RigidTransform& frame_from_mesh, bool completed_too) {
  const auto corner = [&](std::uint32_t v) { return in_cells(mesh.vertices_mm[v], frame_from_mesh); };
  for (const Triangle& t : mesh.triangles)
    if (completed_too || all_three(mesh.measured, t)) add_triangle(corner(t[0]), corner(t[1]), corner(t[2]));
}

void FaceRelief::add_both(const FaceMesh& mesh, const RigidTransform& frame_from_mesh, FaceRelief& measured,
                          FaceRelief& shown, StageContext& context) {
  const Arena::Mark mark(context.scratch);
  std::pmr::vector<Vec3f> corners(mesh.vertices_mm.size(), Vec3f{}, &context.scratch);
  context.pool.for_each<std::size_t>(int(corners.size()), kParts, [&](std::size_t v) {
    corners[v] = measured.in_cells(mesh.vertices_mm[v], frame_from_mesh);
  });
  struct Part {
    FaceRelief measured, completed;
  };
  std::pmr::vector<Part> parts(&context.scratch);
  parts.reserve(kParts);
  for (int k = 0; k < kParts; ++k)
    parts.push_back({FaceRelief(shown.box_, &context.scratch), FaceRelief(shown.box_, &context.scratch)});
  context.pool.for_each<std::size_t>(int(mesh.triangles.size()), kParts, [&](std::size_t i, int k) {
    const auto& t = mesh.triangles[i];
    Part& part = parts[std::size_t(k)];
    FaceRelief& relief = all_three(mesh.measured, t) ? part.measured : part.completed;
    relief.add_triangle(corners[t[0]], corners[t[1]], corners[t[2]]);
  });
  for (const Part& part : parts) {
    measured.add_foremost(part.measured);
    shown.add_foremost(part.measured);
    shown.add_foremost(part.completed);
  }
}

void FaceRelief::add_foremost(const FaceRelief& other) {
  for (std::size_t k = 0; k < z_.size(); ++k)
    if (!std::isnan(other.z_[k]) && !(z_[k] >= other.z_[k])) z_[k] = other.z_[k];
}

void FaceRelief::symmetrise() {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_ / 2; ++column) {
      float& left = z(column, row);
      float& right = z(columns_ - 1 - column, row);
      const float both = std::isnan(left) ? right : std::isnan(right) ? left : 0.5F * (left + right);
      left = right = both;
    }
}

void FaceRelief::smooth_along(bool rows, const std::pmr::vector<float>& kernel,
                              std::pmr::vector<float>& line) {
  const int lines = rows ? rows_ : columns_;
  const int length = rows ? columns_ : rows_;
  const int reach = int(kernel.size()) - 1;
  for (int l = 0; l < lines; ++l) {
    for (int i = 0; i < length; ++i) line[std::size_t(i)] = rows ? z(i, l) : z(l, i);
    for (int i = 0; i < length; ++i) {
      const float middle = line[std::size_t(i)];
      if (std::isnan(middle)) continue;
      float sum = 0;
      float weight = 0;
      for (int k = std::max(0, i - reach); k <= std::min(length - 1, i + reach); ++k) {
        const float value = line[std::size_t(k)];
        if (std::isnan(value)) continue;
        const float w = kernel[std::size_t(std::abs(k - i))];
        sum += w * value;
        weight += w;
      }
      (rows ? z(i, l) : z(l, i)) = sum / weight;
    }
  }
}

void FaceRelief::smooth(double sigma_mm, std::pmr::memory_resource* scratch) {
  const double sigma = sigma_mm / box_.cell_mm;
  const auto reach = std::size_t(std::ceil(3 * sigma));
  std::pmr::vector<float> kernel(reach + 1, 0.0F, scratch);
  for (std::size_t i = 0; i <= reach; ++i)
    kernel[i] = float(std::exp(-0.5 * double(i * i) / (sigma * sigma)));
  std::pmr::vector<float> line(std::size_t(std::max(columns_, rows_)), 0.0F, scratch);
  smooth_along(true, kernel, line);
  smooth_along(false, kernel, line);
}

}  // namespace relievo::pipeline
