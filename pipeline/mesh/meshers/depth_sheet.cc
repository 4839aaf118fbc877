// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/depth_sheet.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/meshers/nearest_vertex.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr float kReachEdges = 1.2F;  // how many usual edges a node may lie from a measured point ...
constexpr float kDisagreeMm = 0.5F;  // ... and how far from the surface around it
constexpr float kDisagreeSigmas = 4;
constexpr int kBands = 64;

struct Lattice {
  double left, top, step;
  int columns, rows;
};

// The nodes of one row: those near a measured point, on its tangent plane but for the tolerance.
void add_row(const FaceMesh& base, const DepthSamples& samples, const NearestVertex& nearest,
             const Lattice& lattice, int row, std::span<const double> us, std::span<const double> depths,
             float reach, PointCloud& cloud) {
  const double v = lattice.top + lattice.step * row;
  for (int c = 0; c < lattice.columns; ++c) {
    const std::size_t i = static_cast<std::size_t>(c);
    if (!std::isfinite(depths[i]) || depths[i] <= 0) continue;
    const Vec3f at{static_cast<float>(us[i] / samples.usual_depth_mm * depths[i]),
                   static_cast<float>(v / samples.usual_depth_mm * depths[i]), static_cast<float>(depths[i])};
    const auto hit = nearest.find(at, 3 * reach + 2 * kDisagreeMm);
    if (hit.vertex == NearestVertex::kNone) continue;
    const Vec3f from = mesh::minus(at, base.vertices_mm[hit.vertex]);
    const float off = std::abs(mesh::dot(from, base.normals[hit.vertex]));
    if (off > kDisagreeMm + kDisagreeSigmas * base.sigma_mm[hit.vertex] ||
        hit.squared_mm - off * off > reach * reach)
      continue;
    cloud.points.push_back({at,
                            {static_cast<float>(c), static_cast<float>(row)},
                            static_cast<float>(samples.sigma[hit.vertex])});
  }
}

}  // namespace

Result<void> SheetOptions::check(const char* place) const {
  if (!(step_mm >= 0.2 && step_mm <= 10))
    return Error{Errc::InvalidInput, "step_mm must lie in 0.2 .. 10"}.at(place);
  if (max_triangles < 1000 || max_triangles > 10'000'000)
    return Error{Errc::InvalidInput, "max_triangles must lie in 1000 .. 10000000"}.at(place);
  if (!(min_area_mm2 >= 0 && min_area_mm2 <= 1e6))
    return Error{Errc::InvalidInput, "min_area_mm2 must lie in 0 .. 1000000"}.at(place);
  return {};
}

DepthSamples sample_depths(const FaceMesh& base, std::pmr::memory_resource* memory) {
  DepthSamples samples(memory);
  const std::size_t n = base.vertices_mm.size();
  for (auto* values : {&samples.u, &samples.v, &samples.depth, &samples.sigma}) values->reserve(n);
  for (const Vec3f& p : base.vertices_mm)
    samples.usual_depth_mm += static_cast<double>(p.z) / static_cast<double>(n);
  samples.left = samples.top = 1e9;
  samples.right = samples.bottom = -1e9;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f& p = base.vertices_mm[i];
    const double z = static_cast<double>(p.z);
    samples.u.push_back(samples.usual_depth_mm * static_cast<double>(p.x) / z);
    samples.v.push_back(samples.usual_depth_mm * static_cast<double>(p.y) / z);
    samples.depth.push_back(z);
    // The base's sigma is perpendicular; along the line of sight it is larger where the surface is steep.
    const double cosine = std::abs(static_cast<double>(mesh::dot(base.normals[i], mesh::unit(p))));
    samples.sigma.push_back(static_cast<double>(base.sigma_mm[i]) / std::max(cosine, 0.1));
    samples.left = std::min(samples.left, samples.u.back());
    samples.right = std::max(samples.right, samples.u.back());
    samples.top = std::min(samples.top, samples.v.back());
    samples.bottom = std::max(samples.bottom, samples.v.back());
  }
  return samples;
}

Result<FaceMesh> mesh_sheet(const FaceMesh& base, const DepthSamples& samples, const DepthFunction& function,
                            const SheetOptions& options, StageContext& context) {
  const NearestVertex nearest(base.vertices_mm, &context.scratch);
  const Lattice lattice{samples.left, samples.top, options.step_mm,
                        static_cast<int>((samples.right - samples.left) / options.step_mm) + 1,
                        static_cast<int>((samples.bottom - samples.top) / options.step_mm) + 1};
  const std::size_t columns = static_cast<std::size_t>(lattice.columns);
  std::pmr::vector<double> us(columns, 0.0, &context.scratch);
  for (std::size_t c = 0; c < columns; ++c) us[c] = lattice.left + lattice.step * static_cast<double>(c);
  std::pmr::vector<double> depths(columns * static_cast<std::size_t>(lattice.rows), 0.0, &context.scratch);
  context.pool.for_each_band(lattice.rows, kBands, [&](int from, int to, int) {
    for (int r = from; r < to && !context.stop(); ++r)
      function(us, lattice.top + lattice.step * r,
               std::span(depths).subspan(static_cast<std::size_t>(r) * columns, columns));
  });
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  const float reach =
      kReachEdges * std::max(usual_edge_mm(base, &context.scratch), static_cast<float>(options.step_mm));
  PointCloud cloud(&context.scratch);
  cloud.points.reserve(columns * static_cast<std::size_t>(lattice.rows));
  cloud.lattice_step_px = 1;
  for (int r = 0; r < lattice.rows; ++r)
    add_row(base, samples, nearest, lattice, r, us,
            std::span(depths).subspan(static_cast<std::size_t>(r) * columns, columns), reach, cloud);
  return lattice_sheet(cloud, options.max_triangles, options.min_area_mm2, context);
}

}  // namespace relievo::pipeline
