// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each photograph shows in every texel of the chart, and how well it looks at it.
// Cosine weights after Debevec, Taylor, Malik: "Modeling and rendering architecture from photographs",
// SIGGRAPH 1996; a view's say fades before an occlusion begins (feathering).
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {

struct ShotOptions {
  float angle_power;   // weight of a view: cosine of its angle of incidence to this power
  float occlusion_px;  // disparity by which something in front hides a point
  float feather_px;    // pixels over which a view's say fades towards an occlusion
  bool left_only;      // the right photograph has no say at all
};

inline constexpr std::uint8_t kSeenLeft = 1, kSeenRight = 2, kSurface = 4;

// Calls step(from, to) along edges until no call says that it changed anything, or until it is stopped.
// Triangles run along rows: a pass each way reaches far.
template <typename Step>
void sweep_edges(std::span<const Triangle> triangles, const StageContext& context, Step&& step) {
  bool changed = true;
  const auto go = [&](const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 1; j < 3; ++j) changed = step(t[i], t[(i + j) % 3]) || changed;
  };
  while (changed && !context.stop()) {
    changed = false;
    std::ranges::for_each(triangles, go);
    std::for_each(triangles.rbegin(), triangles.rend(), go);
  }
}

// What is known of the vertices before any texel is looked at; half of it where it was stopped.
struct VertexViews {
  explicit VertexViews(std::pmr::memory_resource* memory) : share(memory), seen(memory) {}
  std::pmr::vector<float> share;        // of the right view by the angles alone, 0 to 1
  std::pmr::vector<std::uint8_t> seen;  // kSeenLeft | kSeenRight
};
VertexViews look_at_vertices(const FaceMesh& mesh, const RectifiedPair& pair, const Chart& chart,
                             const FrontMap& left, const FrontMap& right, const ShotOptions& options,
                             StageContext& context);

struct ShotPlanes {
  std::size_t texels;
  std::pmr::memory_resource* memory;
  std::pmr::vector<std::uint8_t> left{3 * texels, 0, memory}, right{left, memory};  // 3 a texel
  std::pmr::vector<std::uint8_t> seen{texels, 0, memory};  // kSeenLeft | kSeenRight | kSurface
  // Of the right view by the angles alone, 0 to 255.
  std::pmr::vector<std::uint8_t> share{texels, 0, memory};
  // 255 where the view sees it, 0 near what hides it.
  std::pmr::vector<std::uint8_t> say_left{texels, 0, memory}, say_right{texels, 0, memory};
};

// `kept`: one a triangle, 1 where the chart is its place. maps: middle, left, right.
ShotPlanes shoot(const FaceMesh& mesh, const RectifiedPair& pair, const Chart& chart, const RowBands& bands,
                 std::span<const FrontMap> maps, const VertexViews& views, std::span<const std::uint8_t> kept,
                 const ShotOptions& options, StageContext& context);

}  // namespace relievo::pipeline
