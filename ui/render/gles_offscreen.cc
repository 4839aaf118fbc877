// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GLES3/gl3.h>

#include "ui/render/renderer.h"

namespace relievo::ui {
namespace {

class GlesOffscreen final : public Offscreen {
 public:
  ~GlesOffscreen() override {
    end();
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(1, &colour_);
  }
  Result<void> prepare(int width_px, int height_px) {
    glGenFramebuffers(1, &frame_);
    glGenRenderbuffers(1, &colour_);
    glBindRenderbuffer(GL_RENDERBUFFER, colour_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_px, height_px);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    const bool fine = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    end();
    if (!fine) return Error{Errc::LibraryFailed, "the graphics driver cannot draw a picture of this size"};
    return {};
  }
  void begin() override { glBindFramebuffer(GL_FRAMEBUFFER, frame_); }
  void end() override { glBindFramebuffer(GL_FRAMEBUFFER, 0); }

 private:
  GLuint frame_ = 0, colour_ = 0;
};

}  // namespace

Result<std::unique_ptr<Offscreen>> Offscreen::make(int width_px, int height_px) {
  auto offscreen = std::make_unique<GlesOffscreen>();
  RELIEVO_TRY(offscreen->prepare(width_px, height_px));
  return std::unique_ptr<Offscreen>(std::move(offscreen));
}

}  // namespace relievo::ui
