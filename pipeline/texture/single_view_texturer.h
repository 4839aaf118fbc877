// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SingleViewTexturer (`single-view`): the left photograph alone, as the dissertation does;
// what it does not see is filled.
// Memory: atlas, uv and vertex colours in `output`, the rest in `scratch`; nothing else.
// Errors: InvalidInput (a mesh without triangles, a pair without pixels), OutOfMemory, Cancelled.
// Thread: any; keeps no state.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/texture/texturer.h"

namespace relievo::pipeline {

struct SingleViewTexturerOptions {
  int max_atlas_px = 2048;  // widest and highest atlas
  int margin_px = 8;        // texels left free around the face

  Result<void> check() const;
};

template <typename Field>
void describe(SingleViewTexturerOptions& o, Field&& field) {
  field("max_atlas_px", o.max_atlas_px, OptionRange{64, 8192}, "widest and highest atlas, pixels");
  field("margin_px", o.margin_px, OptionRange{0, 256}, "texels left free around the face");
}

class SingleViewTexturer final : public Texturer {
 public:
  explicit SingleViewTexturer(const SingleViewTexturerOptions& options) : options_(options) {}
  std::string_view name() const override { return "single-view"; }
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair,
                               StageContext& context) const override;

 private:
  SingleViewTexturerOptions options_;
};

}  // namespace relievo::pipeline
