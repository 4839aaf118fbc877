// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far apart the colours on both sides of a texture's seams look (CIEDE2000). A seam is an edge of
// the surface where its two triangles lie in different charts, or where the colour comes mostly from
// another photograph, or from none, on the other side. Judged from the finished model alone.
#pragma once

#include <cstddef>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::test {

struct SeamFigures {
  std::size_t count = 0;
  double median = 0, p95 = 0;
};

struct SeamReport {
  SeamFigures step;    // at the edge itself: a tenth of the triangle to either side
  SeamFigures across;  // between the photographs: means over a millimetre square, 1.5 mm to either side,
                       // beyond how much the face itself changes from there to there
};

// `one_photograph`: the same surface under one view alone, by which the face's own changes are known;
// without it `across` holds them too.
SeamReport measure_seams(const pipeline::FaceMesh& mesh, const pipeline::TextureAtlas& atlas,
                         const pipeline::TextureAtlas* one_photograph = nullptr);

}  // namespace relievo::test
