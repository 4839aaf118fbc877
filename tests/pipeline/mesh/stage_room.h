// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageRoom: a fixture in which a stage is run as the pipeline runs it; the mesher of the default chain in
// it.
#pragma once

#include <numbers>
#include <utility>

#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {

inline constexpr double kDeg = std::numbers::pi / 180;

struct StageRoom : test::StageFixture {
  explicit StageRoom(std::size_t output_bytes = std::size_t{64} << 20,
                     std::size_t scratch_bytes = std::size_t{192} << 20)
      : StageFixture(output_bytes, scratch_bytes) {}

  template <typename Work>
  auto run(Work&& work) {
    return run_stage(context, std::forward<Work>(work));
  }
};

inline Result<FaceMesh> mesh_grid(const PointCloud& cloud, StageRoom& room, const GridMesher& options = {}) {
  return room.run([&](StageContext& c) { return GridMesher(options).mesh(cloud, c); });
}

}  // namespace relievo::pipeline
