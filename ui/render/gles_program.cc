// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GLES3/gl3.h>

#include <iterator>

#include "ui/render/gles_program.h"

namespace relievo::ui {
namespace {

// The object, unless the driver says that it failed: then its words.
Result<GLuint> done(GLuint object, GLenum what, decltype(&glGetShaderiv) status,
                    decltype(&glGetShaderInfoLog) log, decltype(&glDeleteShader) remove, Literal refused) {
  GLint fine = 0;
  status(object, what, &fine);
  if (fine != 0) return object;
  char words[180] = {};
  log(object, sizeof words, nullptr, words);
  remove(object);
  return Error{Errc::LibraryFailed, refused}.at(words);
}

Result<GLuint> compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  const char* const all[] = {"#version 300 es\nprecision highp float;\n",
                             kind == GL_FRAGMENT_SHADER ? "out vec4 colour;\n" : "", source};
  glShaderSource(shader, GLsizei(std::size(all)), all, nullptr);
  glCompileShader(shader);
  return done(shader, GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog, glDeleteShader,
              "the graphics driver refuses a shader: update the driver");
}

}  // namespace

Result<std::uint32_t> compile_program(const char* vertex, const char* fragment) {
  RELIEVO_TRY_ASSIGN(const GLuint first, compile(GL_VERTEX_SHADER, vertex));
  RELIEVO_TRY_ASSIGN(const GLuint second, compile(GL_FRAGMENT_SHADER, fragment));
  const GLuint program = glCreateProgram();
  glAttachShader(program, first);
  glAttachShader(program, second);
  glLinkProgram(program);
  glDeleteShader(first);
  glDeleteShader(second);
  return done(program, GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog, glDeleteProgram,
              "the graphics driver refuses a program: update the driver");
}

void point_at(std::initializer_list<int> attributes, std::size_t first, bool each_instance) {
  constexpr GLuint kMost = 6;
  const auto bytes_of = [](int floats) { return floats == kFourBytes ? 4U : 4U * unsigned(floats); };
  unsigned item = 0;
  for (const int floats : attributes) item += bytes_of(floats);
  std::size_t offset = first * item;
  GLuint i = 0;
  for (const int floats : attributes) {
    const bool bytes = floats == kFourBytes;
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, bytes ? 4 : floats, bytes ? GL_UNSIGNED_BYTE : GL_FLOAT,
                          bytes ? GL_TRUE : GL_FALSE, GLsizei(item),
                          reinterpret_cast<const void*>(offset));  // NOLINT: GL's way of saying an offset
    glVertexAttribDivisor(i++, each_instance ? 1 : 0);
    offset += bytes_of(floats);
  }
  for (; i < kMost; ++i) glDisableVertexAttribArray(i);
}

void smooth_texture() {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace relievo::ui
