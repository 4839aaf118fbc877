// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GLES3/gl3.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "ui/render/gles_program.h"
#include "ui/render/renderer.h"

namespace relievo::ui {
namespace {

constexpr const char* kQuadVertex = R"(
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
constexpr const char* kFlat = R"(
in vec2 place; in vec2 at; flat in vec2 half_size; flat in vec4 fill; flat in vec4 fill_end;
void main() {
  if (abs(at.x) > half_size.x || abs(at.y) > half_size.y) discard;
  float noise = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) - 0.5;
  vec4 c = mix(fill, fill_end, place.y);
  c.rgb += noise / 255.0;
  colour = vec4(c.rgb * c.a, c.a);
}
)";

constexpr const char* kShape = R"(
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

constexpr const char* kGlyph = R"(
precision mediump float;
in vec2 place; in vec2 texel; flat in vec4 fill;
uniform sampler2D picture;
void main() {
  if (place.x < 0.0 || place.y < 0.0 || place.x > 1.0 || place.y > 1.0) discard;
  float a = texture(picture, texel).r * fill.a;
  colour = vec4(fill.rgb * a, a);
}
)";

constexpr const char* kImage = R"(
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
constexpr const char* kRing = R"(
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

constexpr std::size_t kPrograms = 5;  // in the order of Mark; a Face is an Image
constexpr int kFinePx = 1024;  // a wider picture may be shown so small that single pixels would sparkle

struct Instance {
  Rect rect, uv;
  Colour fill, fill_end, border;
  float radius, border_px, blur_px, share;
};

std::size_t program_of(Mark mark) { return std::size_t(mark == Mark::Face ? Mark::Image : mark); }

struct Program {
  GLuint name = 0;
  GLint screen = -1, texels = -1;
};

class GlesRenderer final : public Renderer {
 public:
  ~GlesRenderer() override {
    for (const Program& program : programs_) glDeleteProgram(program.name);
    glDeleteTextures(1, &atlas_);
    glDeleteTextures(static_cast<GLsizei>(pictures_.size()), pictures_.data());
    glDeleteBuffers(1, &buffer_);
    glDeleteVertexArrays(1, &array_);
  }

  Result<void> prepare() {
    const char* const fragments[kPrograms] = {kFlat, kShape, kGlyph, kImage, kRing};
    for (std::size_t i = 0; i < kPrograms; ++i) {
      RELIEVO_TRY_ASSIGN(programs_[i].name, compile_program(kQuadVertex, fragments[i]));
      programs_[i].screen = glGetUniformLocation(programs_[i].name, "screen");
      programs_[i].texels = glGetUniformLocation(programs_[i].name, "texels");
    }
    for (auto& view : faces_) {
      RELIEVO_TRY_ASSIGN(view, FaceView::make());
    }
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &buffer_);
    glGenTextures(1, &atlas_);
    glGenTextures(static_cast<GLsizei>(pictures_.size()), pictures_.data());
    instances_.reserve(1024);
    return {};
  }

  void draw(const DrawList& list, TextAtlas& atlas, int width_px, int height_px) override {
    width_ = width_px;
    height_ = height_px;
    upload_atlas(atlas);
    for (std::size_t i = 1; i < kPictureSlots; ++i) upload_picture(i, list.pictures[i]);
    forget_faces(list);
    upload_instances(list);
    glViewport(0, 0, width_px, height_px);
    glClearColor(0, 0, 0, 1);
    glDisable(GL_SCISSOR_TEST);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);
    std::size_t first = 0;
    while (first < list.commands.size()) {
      std::size_t last = first + 1;
      while (last < list.commands.size() && together(list.commands[first], list.commands[last])) ++last;
      draw_batch(list, first, last);
      first = last;
    }
    glFinish();  // a finger is answered by the next frame: it must not queue behind frames nobody has seen
  }

  // No drawing of ours is an error, so each is the driver's: a context that was reset, memory that is used
  // up.
  bool lost() const override { return glGetError() != GL_NO_ERROR || glGetString(GL_RENDERER) == nullptr; }

  void read_back(std::span<std::uint8_t> rgb, int width_px, int height_px) override {
    const std::size_t row = std::size_t(width_px) * 4;
    std::vector<std::uint8_t> pixels(row * std::size_t(height_px));
    glReadPixels(0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    std::uint8_t* to = rgb.data();
    for (int y = height_px - 1; y >= 0; --y) {
      const std::uint8_t* from = pixels.data() + row * std::size_t(y);
      for (int x = 0; x < width_px; ++x, from += 4, to += 3) std::memcpy(to, from, 3);
    }
  }

  void forget() override {
    for (const auto& view : faces_) view->forget();
    glDeleteTextures(static_cast<GLsizei>(pictures_.size()), pictures_.data());
    glGenTextures(static_cast<GLsizei>(pictures_.size()), pictures_.data());
    versions_.fill(0);
    atlas_generation_ = 0;
  }

 private:
  static bool together(const Command& a, const Command& b) {
    return a.mark == b.mark && a.mark != Mark::Face && a.clip == b.clip && a.picture == b.picture;
  }

  void upload_atlas(TextAtlas& atlas) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindTexture(GL_TEXTURE_2D, atlas_);
    const int side = atlas.side_px();
    TextAtlas::Rows rows = atlas.take_changed();
    if (atlas_generation_ == 0) {
      glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, side, side, 0, GL_RED, GL_UNSIGNED_BYTE, atlas.texels());
      smooth_texture();
    } else if (rows.first < rows.last) {
      glTexSubImage2D(GL_TEXTURE_2D, 0, 0, rows.first, side, rows.last - rows.first, GL_RED, GL_UNSIGNED_BYTE,
                      atlas.row(0, rows.first));
    }
    atlas_generation_ = atlas.generation();
    atlas_side_ = float(side);
  }

  void upload_picture(std::size_t slot, const Picture& picture) {
    if (picture.version == versions_[slot] || picture.version == 0 || picture.pixels.empty()) return;
    const ImageView& view = picture.pixels;
    const bool grey = view.format == PixelFormat::Grey8;
    glBindTexture(GL_TEXTURE_2D, pictures_[slot]);
    glTexImage2D(GL_TEXTURE_2D, 0, grey ? GL_R8 : GL_RGB8, view.width_px, view.height_px, 0,
                 grey ? GL_RED : GL_RGB, GL_UNSIGNED_BYTE, view.bytes);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, grey ? GL_RED : GL_GREEN);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, grey ? GL_RED : GL_BLUE);
    smooth_texture();
    if (view.width_px > kFinePx) {
      glGenerateMipmap(GL_TEXTURE_2D);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    }
    versions_[slot] = picture.version;
  }

  // Models beside the first are seldom there: what was uploaded of them goes with them.
  void forget_faces(const DrawList& list) {
    for (std::size_t i = 1; i < kFaces; ++i) {
      if (list.faces[i].version == 0 && had_face_[i]) faces_[i]->forget();
      had_face_[i] = list.faces[i].version != 0;
    }
  }

  void upload_instances(const DrawList& list) {
    instances_.clear();
    for (const Command& c : list.commands) {
      Rect uv = c.uv;
      if (c.mark == Mark::Face) uv = {0, 1, 1, -1};  // its first row is the bottom one
      instances_.push_back(
          {c.rect, uv, c.fill, c.fill_end, c.border, c.radius, c.border_px, c.blur_px, c.share});
    }
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)),
                 instances_.data(), GL_STREAM_DRAW);
  }

  void draw_batch(const DrawList& list, std::size_t first, std::size_t last) {
    const Command& c = list.commands[first];
    GLuint texture = c.mark == Mark::Glyph ? atlas_ : pictures_[std::size_t(c.picture)];
    if (c.mark == Mark::Face) {
      texture = faces_[c.face]->draw(list.faces[c.face], list.face_look, int(std::lround(c.rect.w)),
                                     int(std::lround(c.rect.h)), 1 - c.share);
      if (texture == 0) return;
      glViewport(0, 0, width_, height_);
      glEnable(GL_BLEND);
      glEnable(GL_SCISSOR_TEST);
    }
    if (c.mark == Mark::Image && versions_[std::size_t(c.picture)] == 0) return;
    const float x0 = std::max(0.0F, std::floor(c.clip.x)), y1 = std::ceil(c.clip.bottom());
    glScissor(static_cast<GLint>(x0), static_cast<GLint>(float(height_) - y1),
              static_cast<GLsizei>(std::max(0.0F, std::ceil(c.clip.right()) - x0)),
              static_cast<GLsizei>(std::max(0.0F, y1 - std::floor(c.clip.y))));
    const Program& program = programs_[program_of(c.mark)];
    glUseProgram(program.name);
    glUniform2f(program.screen, float(width_), float(height_));
    const float side = c.mark == Mark::Glyph ? atlas_side_ : 1.0F;
    if (program.texels >= 0) glUniform2f(program.texels, side, side);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    point_at({4, 4, kFourBytes, kFourBytes, kFourBytes, 4}, first, true);  // an Instance
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(last - first));
  }

  std::array<Program, kPrograms> programs_{};
  std::array<std::unique_ptr<FaceView>, kFaces> faces_;
  std::array<bool, kFaces> had_face_{};
  GLuint array_ = 0, buffer_ = 0, atlas_ = 0;
  std::array<GLuint, kPictureSlots> pictures_{};
  std::array<std::uint32_t, kPictureSlots> versions_{};
  std::uint32_t atlas_generation_ = 0;
  float atlas_side_ = 1;
  std::vector<Instance> instances_;
  int width_ = 0, height_ = 0;
};

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::make() {
  auto renderer = std::make_unique<GlesRenderer>();
  RELIEVO_TRY(renderer->prepare());
  return std::unique_ptr<Renderer>(std::move(renderer));
}

Result<std::unique_ptr<Offscreen>> Offscreen::make(int width_px, int height_px) {
  auto made = std::make_unique<Offscreen>();
  glGenFramebuffers(1, &made->frame_);
  glGenRenderbuffers(1, &made->colour_);
  glBindRenderbuffer(GL_RENDERBUFFER, made->colour_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_px, height_px);
  made->begin();
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, made->colour_);
  const bool fine = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  made->end();
  if (!fine) return Error{Errc::LibraryFailed, "the graphics driver cannot draw a picture of this size"};
  return made;
}

Offscreen::~Offscreen() {
  end();
  glDeleteFramebuffers(1, &frame_);
  glDeleteRenderbuffers(1, &colour_);
}

void Offscreen::begin() { glBindFramebuffer(GL_FRAMEBUFFER, frame_); }
void Offscreen::end() { glBindFramebuffer(GL_FRAMEBUFFER, 0); }

}  // namespace relievo::ui
