// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GLES3/gl3.h>

#include <iterator>

#include "ui/render/gles_program.h"

namespace relievo::ui {
namespace {

Result<GLuint> compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  const char* const all[] = {"#version 300 es\nprecision highp float;\n",
                             kind == GL_FRAGMENT_SHADER ? "out vec4 colour;\n" : "", source};
  glShaderSource(shader, GLsizei(std::size(all)), all, nullptr);
  glCompileShader(shader);
  GLint fine = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  if (fine != 0) return shader;
  char words[180] = {};
  glGetShaderInfoLog(shader, sizeof words, nullptr, words);
  glDeleteShader(shader);
  return Error{Errc::LibraryFailed, "the graphics driver refuses a shader: update the driver"}.at(words);
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
  GLint fine = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &fine);
  if (fine != 0) return program;
  char words[180] = {};
  glGetProgramInfoLog(program, sizeof words, nullptr, words);
  glDeleteProgram(program);
  return Error{Errc::LibraryFailed, "the graphics driver refuses a program: update the driver"}.at(words);
}

namespace shader {

const char* const kQuadVertex = R"(
layout(location = 0) in vec4 rect;
layout(location = 1) in vec4 uv;
layout(location = 2) in vec4 fill_in;
layout(location = 3) in vec4 fill_end_in;
layout(location = 4) in vec4 border_in;
layout(location = 5) in vec4 numbers_in;  // radius, border, blur, share
uniform vec2 screen;
uniform vec2 texels;
out vec2 at;         // pixels from the middle
out vec2 place;      // 0 to 1
out vec2 texel;
flat out vec2 half_size;
flat out vec4 fill; flat out vec4 fill_end; flat out vec4 border; flat out vec4 numbers;
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
  float margin = numbers_in.z * 2.0 + 1.0;          // room for the shadow and the soft edge
  vec2 pixel = rect.xy - margin + corner * (rect.zw + 2.0 * margin);
  half_size = rect.zw * 0.5;
  at = pixel - rect.xy - half_size;
  place = (pixel - rect.xy) / rect.zw;
  texel = (uv.xy + place * uv.zw) / texels;
  fill = fill_in; fill_end = fill_end_in; border = border_in; numbers = numbers_in;
  gl_Position = vec4(pixel.x / screen.x * 2.0 - 1.0, 1.0 - pixel.y / screen.y * 2.0, 0.0, 1.0);
}
)";

// A gradient over a large dark ground shows steps: a little noise, the same in every frame, hides them.
const char* const kFlat = R"(
in vec2 place; in vec2 at; flat in vec2 half_size; flat in vec4 fill; flat in vec4 fill_end;
void main() {
  if (abs(at.x) > half_size.x || abs(at.y) > half_size.y) discard;
  float noise = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) - 0.5;
  vec4 c = mix(fill, fill_end, place.y);
  c.rgb += noise / 255.0;
  colour = vec4(c.rgb * c.a, c.a);
}
)";

const char* const kShape = R"(
in vec2 place; in vec2 at; flat in vec2 half_size;
flat in vec4 fill; flat in vec4 fill_end; flat in vec4 border; flat in vec4 numbers;
void main() {
  vec2 q = abs(at) - half_size + numbers.x;
  float d = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - numbers.x;
  vec4 c = mix(fill, fill_end, clamp(place.y, 0.0, 1.0));
  if (numbers.z > 0.0) {
    float s = clamp(0.5 - d / (2.0 * numbers.z), 0.0, 1.0);
    c.a *= s * s * (3.0 - 2.0 * s);
    colour = vec4(c.rgb * c.a, c.a);
    return;
  }
  vec4 inside = vec4(c.rgb * c.a, c.a);
  vec4 line = vec4(border.rgb * border.a, border.a);
  float in_line = numbers.y > 0.0 ? clamp(0.5 + d + numbers.y, 0.0, 1.0) : 0.0;
  vec4 covered = inside * (1.0 - in_line * border.a) + line * in_line;
  colour = covered * clamp(0.5 - d, 0.0, 1.0);
}
)";

const char* const kGlyph = R"(
precision mediump float;
in vec2 place; in vec2 texel; flat in vec4 fill;
uniform sampler2D picture;
void main() {
  if (place.x < 0.0 || place.y < 0.0 || place.x > 1.0 || place.y > 1.0) discard;
  float a = texture(picture, texel).r * fill.a;
  colour = vec4(fill.rgb * a, a);
}
)";

const char* const kImage = R"(
in vec2 at; in vec2 texel; flat in vec2 half_size; flat in vec4 numbers; flat in vec4 fill;
uniform sampler2D picture;
void main() {
  vec2 q = abs(at) - half_size + numbers.x;
  float d = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - numbers.x;
  vec4 c = texture(picture, texel);
  float a = clamp(0.5 - d, 0.0, 1.0) * fill.a;
  colour = c * a;
}
)";

// numbers: half of the line, the line, nothing, share. The distance to an ellipse, first order (Taubin 1994).
const char* const kRing = R"(
in vec2 at; in vec2 texel; flat in vec4 fill; flat in vec4 border; flat in vec4 numbers;
void main() {
  vec2 r = texel - numbers.x;  // its half axes: the same in every corner
  vec2 p = at / r;
  float f = length(p);
  float d = f < 1e-4 ? -min(r.x, r.y) : (f - 1.0) * f / length(at / (r * r));
  float turn = fract(atan(at.x / r.x, -at.y / r.y) / 6.2831853 + 1.0);
  float line = clamp(0.5 + numbers.y * 0.5 - abs(d), 0.0, 1.0) * (turn <= numbers.w ? 1.0 : 0.22);
  float outside = clamp(0.5 + d, 0.0, 1.0) * fill.a;
  vec4 under = vec4(fill.rgb, 1.0) * outside;
  float a = line * border.a;
  colour = under * (1.0 - a) + vec4(border.rgb, 1.0) * a;
}
)";

const char* const kFaceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 uv;
layout(location = 3) in float within_in;
uniform mat4 clip_from_head;
uniform mat3 turned;
out vec3 normal; out vec2 texel; out vec3 seen_from; out float within;
uniform vec3 eye;
uniform float edges;
void main() {
  normal = turned * normal_in;
  seen_from = eye - turned * position;
  texel = uv;
  within = within_in;
  gl_Position = clip_from_head * vec4(position, 1.0);
  gl_Position.z -= edges * 0.0015 * gl_Position.w;  // sides are chords, which lie a little behind what is round
}
)";

const char* const kFace = R"(
in vec3 normal; in vec2 texel; in vec3 seen_from; in float within;
uniform sampler2D picture;
uniform vec3 light;
uniform float textured, lit, filled, edges, fading, opacity;
void main() {
  vec3 n = normalize(normal);
  vec3 v = normalize(seen_from);
  if (dot(n, v) < 0.0) n = -n;
  float key = max(dot(n, light), 0.0);
  float fill_light = max(dot(n, normalize(vec3(-light.x, 0.2, 0.6))), 0.0);
  float rim = pow(1.0 - max(dot(n, v), 0.0), 3.0);
  // The photograph holds its own light already: ours only models it a little.
  vec3 skin = texture(picture, texel).rgb * (0.72 + 0.52 * key + 0.20 * fill_light);
  vec3 clay = vec3(0.80, 0.82, 0.86) * (0.16 + 0.74 * key + 0.18 * fill_light) + vec3(0.05, 0.07, 0.10) * rim;
  if (lit < 0.5) {
    skin = texture(picture, texel).rgb;
    clay = vec3(0.62, 0.65, 0.70);
  }
  vec3 surface = mix(clay, skin, textured);
  // Sides are dark on the surface; without it they have the skin's colour, or a light one in clay's place.
  if (edges > 0.5) surface = filled > 0.5 ? vec3(0.05, 0.13, 0.22) : mix(clay * vec3(0.56, 0.98, 1.16), skin, textured);
  float there = mix(1.0, smoothstep(0.0, 1.0, within), fading);
  if (edges > 0.5 && filled > 0.5) there *= 0.7;
  there *= opacity;
  colour = vec4(surface * there, there);
}
)";

const char* const kBackdropVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 rgba;
uniform mat4 clip_from_head;
out vec4 tint;
void main() {
  tint = rgba;
  gl_Position = clip_from_head * vec4(position, 1.0);
}
)";

const char* const kBackdrop = R"(
precision mediump float;
in vec4 tint;
uniform float opacity;
void main() {
  float a = tint.a * opacity;
  colour = vec4(tint.rgb * a, a);
}
)";

// A little before the surface they lie on.
const char* const kPointVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_head;
uniform float size;
out float depth;
void main() {
  gl_Position = clip_from_head * vec4(position, 1.0);
  gl_Position.z -= 0.004 * gl_Position.w;
  gl_PointSize = size;
  depth = clamp((position.z + 75.0) / 125.0, 0.0, 1.0);
}
)";

const char* const kPoint = R"(
precision mediump float;
in float depth;
uniform float opacity;
void main() {
  vec3 far = vec3(0.20, 0.33, 0.75), middle = vec3(0.25, 0.78, 0.67), near = vec3(1.0, 0.69, 0.25);
  vec3 tint = depth < 0.5 ? mix(far, middle, depth * 2.0) : mix(middle, near, depth * 2.0 - 1.0);
  colour = vec4(tint * opacity, opacity);
}
)";

}  // namespace shader

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
