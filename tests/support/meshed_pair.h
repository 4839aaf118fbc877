// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages from a stereo frame to its mesh, for tests of what comes after. The stages' errors.
#pragma once

#include <utility>

#include "pipeline/pipeline.h"

namespace relievo::test {

struct MeshedPair {
  pipeline::RectifiedPair pair;
  pipeline::FaceMesh mesh;
};

inline Result<MeshedPair> mesh_of(const pipeline::Pipeline& pipeline, const pipeline::StereoFrame& frame,
                                  pipeline::StageContext& context) {
  RELIEVO_TRY_ASSIGN(auto pair, pipeline.rectify(frame, context));
  RELIEVO_TRY_ASSIGN(const auto matches, pipeline.match(pair, context));
  RELIEVO_TRY_ASSIGN(const auto cloud, pipeline.reconstruct(pair, matches, context));
  RELIEVO_TRY_ASSIGN(auto mesh, pipeline.mesh(cloud, pair, context));
  return MeshedPair{std::move(pair), std::move(mesh)};
}

}  // namespace relievo::test
