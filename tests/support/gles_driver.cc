// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/gles_driver.h"

#include <EGL/egl.h>
#include <GLES3/gl3.h>

namespace relievo::test {

std::string gles_driver() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? std::string() : reinterpret_cast<const char*>(name);
}

void lose_gles_context() {
  eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace relievo::test
