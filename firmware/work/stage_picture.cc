// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/stage_picture.h"

#include "firmware/work/stage_drawing.h"

namespace relievo::firmware {

void draw_stage_picture(State stage, const Products& products, StagePictures& pictures) {
  if (!products.pair) return;
  const auto& pair = *products.pair;
  if (stage == State::Match && products.matches) {
    StageCanvas canvas(pictures.begin(0), StagePictures::kSide);
    draw_matches(pair, *products.matches, canvas);
    pictures.done(0);
  } else if (stage == State::Reconstruct && products.cloud) {
    StageCanvas canvas(pictures.begin(1), StagePictures::kSide);
    draw_cloud(pair, *products.cloud, canvas);
    pictures.done(1);
  } else if (stage == State::Mesh && products.mesh) {
    StageCanvas canvas(pictures.begin(2), StagePictures::kSide);
    draw_surface(pair, *products.mesh, nullptr, canvas);
    pictures.done(2);
  } else if (stage == State::Texture && products.mesh && products.texture) {
    StageCanvas canvas(pictures.begin(3), StagePictures::kSide);
    draw_surface(pair, *products.mesh, &*products.texture, canvas);
    pictures.done(3);
  }
}

}  // namespace relievo::firmware
