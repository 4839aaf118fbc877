// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours where there is no photograph: on surface that was completed, and beyond the charts.
// Thread: one. Throw std::bad_alloc.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

using VertexColour = std::array<float, 3>;

// Vertices with known == 0 take the membrane spanned by the known ones around them: every colour the
// mean of its neighbours', by relaxation in the order in which the known ones reach them. Vertices no
// known one reaches take the mean of all.
void fill_colours(const FaceMesh& mesh, std::span<const std::uint8_t> known, std::span<VertexColour> colours,
                  StageContext& context);

// Paints the texels of a triangle, left of `width_px`, that show no photograph: between the colours of its
// vertices. One shared with a photographed neighbour at their edge stays.
void fill_triangle(const Vec2f& a, const Vec2f& b, const Vec2f& c, const Triangle& t,
                   std::span<const VertexColour> colours, int width_px, TextureAtlas& atlas);

void write_vertex_colours(std::span<const VertexColour> colours, TextureAtlas& atlas);

// Paints what lies beyond the charts: `margin_px` texels with the nearest colour from a little inside
// (the outermost texels mix in what lies behind the face; a chart too thin goes on from those), the rest with
// the mean: filters and smaller copies mix in skin, not black. Nothing of the room gets into the atlas.
void continue_outwards(TextureAtlas& atlas, int margin_px, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
