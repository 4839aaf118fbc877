// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceView: the model in three dimensions, drawn into a texture of its own and only when something
// changed. Twice as fine as the screen, so that edges are smooth without multi-sampling.
// Thread: main, with a current context. Errors of make(): LibraryFailed.
#pragma once

#include <memory>

#include "hal/base/result.h"
#include "ui/draw/draw_list.h"

namespace relievo::ui {

class FaceView {
 public:
  static Result<std::unique_ptr<FaceView>> make();
  virtual ~FaceView() = default;
  // The GL name of a texture with the model on nothing (premultiplied alpha; its first row is the
  // bottom one); 0 when there is no model. Leaves the framebuffer bound that was. Without a cloud the model's
  // vertices are its points. `covered`: the share of the window, at its lower end, that something else lies
  // on: the model stands in the middle of the rest.
  virtual std::uint32_t draw(const Face& subject, const FaceLook& look, int width_px, int height_px,
                             float covered = 0) = 0;
  virtual void forget() = 0;
};

}  // namespace relievo::ui
