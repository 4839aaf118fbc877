// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The texturers.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// TwoViewTexturer (`two-view`, the default): both photographs, each where it sees the surface and the
// more the straighter it looks at it. The right one is first brought to the left one's exposure and
// white balance (view_blend.h), both to one level where they still differ slowly; where one is brighter in
// every channel it holds a highlight and the darker one counts (view_blend.h).
// Surface nobody photographed is filled smoothly and flagged (colour_fill.h).
// Memory: atlas, uv and vertex colours in `output`, the rest in `scratch`. Thread: any; the result does not
// depend on the pool. Errors: InvalidInput (no triangles, a pair without pixels), OutOfMemory, Cancelled.
struct TwoViewTexturer {
  int max_atlas_px = 2048;  // widest and highest atlas
  int margin_px = 8;        // texels left free around the face
  double finer = 1;        // texels a pixel and side of the better photograph: more of them show nothing more
  double angle_power = 4;  // weight of a view: cosine of its angle of incidence to this power
  double occlusion_px = 1.5;    // disparity by which something in front hides a point from the right view
  double feather_px = 6;        // pixels over which a view fades towards an occlusion
  double highlight_level = 12;  // grey levels by which the brighter view loses its say; 0 keeps both

  Result<void> check() const;

  void describe(auto&& field) {
    field("max_atlas_px", max_atlas_px, OptionRange{64, 8192}, "widest and highest atlas, pixels");
    field("margin_px", margin_px, OptionRange{0, 256}, "texels left free around the face");
    field("finer", finer, OptionRange{0.25, 4},
          "texels a pixel and side of the better photograph, as far as the atlas goes");
    field("angle_power", angle_power, OptionRange{0, 64},
          "weight of a view: cosine of its angle of incidence to this power");
    field("occlusion_px", occlusion_px, OptionRange{0, 64},
          "disparity by which something in front hides a point from the right view");
    field("feather_px", feather_px, OptionRange{0, 32},
          "pixels over which a view fades towards an occlusion");
    field("highlight_level", highlight_level, OptionRange{0, 255},
          "grey levels by which the brighter view loses its say");
  }
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context) const;
};

// SingleViewTexturer (`single-view`): the left photograph alone, as the dissertation does; what it does not
// see is filled. Memory, errors, thread: as TwoViewTexturer.
struct SingleViewTexturer {
  int max_atlas_px = 2048;  // widest and highest atlas
  int margin_px = 8;        // texels left free around the face

  Result<void> check() const;

  void describe(auto&& field) {
    field("max_atlas_px", max_atlas_px, OptionRange{64, 8192}, "widest and highest atlas, pixels");
    field("margin_px", margin_px, OptionRange{0, 256}, "texels left free around the face");
  }
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline
