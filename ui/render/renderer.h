// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offscreen: a picture to draw into instead of the window, of any size, 8 bits a channel.
// Thread: main, with a current context. Errors of make(): LibraryFailed (larger than the driver can).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "hal/base/result.h"
#include "ui/draw/draw_list.h"
#include "ui/text/text_engine.h"

namespace relievo::ui {

class Offscreen {
 public:
  static Result<std::unique_ptr<Offscreen>> make(int width_px, int height_px);
  Offscreen() = default;
  Offscreen& operator=(Offscreen&&) = delete;
  ~Offscreen();
  void begin();  // what a Renderer draws and reads back is in here
  void end();

 private:
  std::uint32_t frame_ = 0, colour_ = 0;  // GL's names
};

// FaceView: the model in three dimensions, drawn into a texture of its own and only when something
// changed. Twice as fine as the screen, so that edges are smooth without multi-sampling.
// Thread: main, with a current context. Errors of make(): LibraryFailed.
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

// Renderer: draws a DrawList with OpenGL ES 3. It holds the textures: the text atlas, the pictures,
// the model. What a list no longer shows is cleared from the GL's memory by forget().
// Thread: main, with a current context. Errors of make(): LibraryFailed (no GLES 3, a shader that does
// not compile: the driver's words are in where()).
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> make();
  virtual ~Renderer() = default;

  // Waits until all is drawn: what a program asks for, a driver may do several frames later.
  virtual void draw(const DrawList& list, TextAtlas& atlas, int width_px, int height_px) = 0;
  // Has the driver lost the context, or given up? Then nothing was drawn: only a new one, with a new
  // Renderer, draws again. Waits for the GL.
  virtual bool lost() const = 0;
  // The frame as it was drawn: 3 bytes a pixel, from the top row down. Waits for the GL.
  virtual void read_back(std::span<std::uint8_t> rgb, int width_px, int height_px) = 0;
  // Nothing of a person stays: pictures and model go.
  virtual void forget() = 0;
};

}  // namespace relievo::ui
