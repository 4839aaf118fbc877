// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GLES3/gl3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ui/render/face_geometry.h"
#include "ui/render/gles_program.h"
#include "ui/render/renderer.h"

namespace relievo::ui {
namespace {

constexpr const char* kFaceVertex = R"(
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

constexpr const char* kFace = R"(
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

constexpr const char* kBackdropVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 rgba;
uniform mat4 clip_from_head;
out vec4 tint;
void main() {
  tint = rgba;
  gl_Position = clip_from_head * vec4(position, 1.0);
}
)";

constexpr const char* kBackdrop = R"(
precision mediump float;
in vec4 tint;
uniform float opacity;
void main() {
  float a = tint.a * opacity;
  colour = vec4(tint.rgb * a, a);
}
)";

// A little before the surface they lie on.
constexpr const char* kPointVertex = R"(
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

constexpr const char* kPoint = R"(
precision mediump float;
in float depth;
uniform float opacity;
void main() {
  vec3 far = vec3(0.20, 0.33, 0.75), middle = vec3(0.25, 0.78, 0.67), near = vec3(1.0, 0.69, 0.25);
  vec3 tint = depth < 0.5 ? mix(far, middle, depth * 2.0) : mix(middle, near, depth * 2.0 - 1.0);
  colour = vec4(tint * opacity, opacity);
}
)";

constexpr float kBackdropFromDeg = 20, kBackdropToDeg = 50;  // it fades as the face turns away
constexpr int kMostSidePx = 2048;
constexpr float kEdgePx = 9;  // of the screen: sides shorter than this would run into a grey
constexpr float kEdgeWidthPx = 1.1F;

// How much is seen of each while a portrait comes to be (FaceLook::born): the photograph goes, points come,
// on them the bare surface, on that its colours.
struct Birth {
  float surface, colours, points;
};
Birth birth_of(float born) {
  const auto between = [born](float from, float to) {
    return std::clamp((born - from) / (to - from), 0.0F, 1.0F);
  };
  constexpr float kNoSurface = 0.42F;
  const bool photograph = born < kNoSurface;
  return {photograph ? 1 - between(0.2F, kNoSurface) : between(kNoSurface, 0.68F),
          photograph ? 1 : between(0.72F, 1), std::min(between(0.2F, 0.4F), 1 - between(0.5F, 0.72F))};
}

template <typename Items>
void fill(GLenum target, GLuint& buffer, const Items& items) {
  if (buffer == 0) glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(items.size() * sizeof(items[0])), items.data(),
               GL_STATIC_DRAW);
}

const pipeline::TextureAtlas& atlas_of(const Face& subject) {
  return subject.colours != nullptr ? *subject.colours : subject.model->texture;
}
pipeline::SeamSplit split_of(const Face& subject) {
  return pipeline::split_at_seams(subject.model->mesh, atlas_of(subject).uv);
}

class GlesFaceView final : public FaceView {
 public:
  ~GlesFaceView() override {
    forget();
    glDeleteProgram(program_);
    glDeleteProgram(point_program_);
    glDeleteProgram(backdrop_program_);
    glDeleteVertexArrays(1, &array_);
  }

  Result<void> prepare() {
    RELIEVO_TRY_ASSIGN(program_, compile_program(kFaceVertex, kFace));
    RELIEVO_TRY_ASSIGN(point_program_, compile_program(kPointVertex, kPoint));
    RELIEVO_TRY_ASSIGN(backdrop_program_, compile_program(kBackdropVertex, kBackdrop));
    glGenVertexArrays(1, &array_);
    return {};
  }

  std::uint32_t draw(const Face& subject, const FaceLook& look, int width_px, int height_px,
                     float covered) override {
    if (subject.model == nullptr || subject.version == 0) return 0;
    const std::uint32_t version = subject.version;
    const int most = std::max(width_px, height_px);
    const int times = most * 2 <= kMostSidePx ? 2 : 1;
    const int w = width_px * times, h = height_px * times;
    const bool same =
        version == version_ && look == look_ && covered == covered_ && w == width_ && h == height_;
    if (same && colour_ != 0) return colour_;
    if (version != version_) upload(subject);
    if ((look.points || look.born < 1) && version != points_version_) upload_points(subject);
    if (look.edges) upload_edges(subject, kEdgePx * kSeenHeightMm / (look.zoom * float(height_px)));
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    if (w != width_ || h != height_ || frame_ == 0) make_frame(w, h);
    version_ = version;
    look_ = look;
    birth_ = birth_of(look.born);
    covered_ = covered;
    times_ = times;
    render();
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
    return colour_;
  }

  void forget() override {
    glDeleteBuffers(kBuffers, buffers_.data());
    buffers_ = {};
    glDeleteTextures(1, &texture_);
    glDeleteTextures(1, &colour_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteFramebuffers(1, &frame_);
    texture_ = colour_ = depth_ = frame_ = 0;
    version_ = points_version_ = edges_version_ = 0;
    index_count_ = point_count_ = backdrop_count_ = edge_count_ = width_ = height_ = 0;
  }

 private:
  void upload(const Face& subject) {
    const pipeline::FaceModel& model = *subject.model;
    const pipeline::TextureAtlas& atlas = atlas_of(subject);
    if (texture_ == 0) glGenTextures(1, &texture_);
    const pipeline::SeamSplit split = split_of(subject);
    index_count_ = int(3 * split.triangles.size());
    stand_ = stand_of(model);
    fill(GL_ARRAY_BUFFER, buffers_[Corners], corners_of(model, split));
    glBindVertexArray(array_);  // which keeps the buffer of indices
    fill(GL_ELEMENT_ARRAY_BUFFER, buffers_[Indices], split.triangles);
    const std::vector<Tinted> behind = tinted_of(model);
    backdrop_count_ = int(behind.size());
    fill(GL_ARRAY_BUFFER, buffers_[Behind], behind);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    textured_ = atlas.width_px > 0 && atlas.height_px > 0 && !atlas.rgb.empty();
    if (textured_)
      glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, atlas.width_px, atlas.height_px, 0, GL_RGB, GL_UNSIGNED_BYTE,
                   atlas.rgb.data());
    smooth_texture();
  }

  void upload_points(const Face& subject) {
    std::vector<Dot> dots = dots_of(*subject.model, subject.cloud);
    apart_count_ = int(set_apart(dots));
    point_count_ = int(dots.size());
    points_version_ = subject.version;
    fill(GL_ARRAY_BUFFER, buffers_[Points], dots);
  }

  // Indices of corners, so that sides have normals and texels. A level holds for a range of zooms.
  void upload_edges(const Face& subject, float least_mm) {
    const float level_mm = std::exp2(std::round(2 * std::log2(least_mm)) / 2);
    if (edges_version_ == subject.version && edge_level_mm_ == level_mm) return;
    edges_version_ = subject.version;
    edge_level_mm_ = level_mm;
    const pipeline::FaceMesh& mesh = subject.model->mesh;
    const pipeline::SeamSplit split = split_of(subject);
    std::vector<std::uint32_t> corner(mesh.vertices_mm.size(), 0), indices;
    for (std::size_t i = 0; i < split.entries.size(); ++i) corner[split.entries[i].vertex] = std::uint32_t(i);
    for (const auto& [a, b] : edges_of(mesh, level_mm)) indices.insert(indices.end(), {corner[a], corner[b]});
    edge_count_ = int(indices.size());
    glBindVertexArray(array_);
    fill(GL_ELEMENT_ARRAY_BUFFER, buffers_[Sides], indices);
  }

  void make_frame(int w, int h) {
    if (frame_ == 0) glGenFramebuffers(1, &frame_);
    if (colour_ == 0) glGenTextures(1, &colour_);
    if (depth_ == 0) glGenRenderbuffers(1, &depth_);
    width_ = w;
    height_ = h;
    glBindTexture(GL_TEXTURE_2D, colour_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, w, h, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    smooth_texture();
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, w, h);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  }

  FaceProjection projection() const { return {stand_, look_, float(width_) / float(height_), covered_}; }

  void set_uniforms(const FaceProjection& t) const {
    const float side = radians(look_.light_deg), up = 0.45F, norm = std::sqrt(1 + up * up);
    glUseProgram(program_);
    glUniformMatrix4fv(glGetUniformLocation(program_, "clip_from_head"), 1, GL_FALSE, t.clip_from_model());
    glUniformMatrix3fv(glGetUniformLocation(program_, "turned"), 1, GL_FALSE, t.turned());
    glUniform3f(glGetUniformLocation(program_, "eye"), 0, 0, kFaceDistanceMm);
    glUniform3f(glGetUniformLocation(program_, "light"), std::sin(side) / norm, up / norm,
                std::cos(side) / norm);
    const auto set = [this](const char* name, float value) {
      glUniform1f(glGetUniformLocation(program_, name), value);
    };
    set("textured", look_.textured && textured_ ? birth_.colours : 0.0F);
    set("opacity", birth_.surface);
    set("lit", look_.lit ? 1.0F : 0.0F);
    set("filled", look_.fill ? 1.0F : 0.0F);
    set("edges", 0);
    set("fading", shows_backdrop() ? 1.0F : 0.0F);
    glUniform1i(glGetUniformLocation(program_, "picture"), 0);
  }

  void render() const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glViewport(0, 0, width_, height_);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const FaceProjection t = projection();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (shows_backdrop()) draw_backdrop(t);
    set_uniforms(t);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[Corners]);
    point_at({3, 3, 2, 1});  // a Corner
    if (look_.fill) draw_surface();
    if (look_.edges) draw_edges();
    if (look_.points) draw_points(t, 1, point_count_, 1);
    else if (birth_.points > 0)
      draw_points(t, birth_.points, apart_count_, 2);  // all would run into a surface
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
  }

  // What is seen through must not be its own far side: the nearest of it is looked for first.
  void draw_surface() const {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[Indices]);
    const auto draw = [this] { glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr); };
    if (birth_.surface < 1) {
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      draw();
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      glDepthFunc(GL_LEQUAL);
    }
    draw();
    glDepthFunc(GL_LESS);
  }

  bool shows_backdrop() const { return look_.backdrop && look_.textured && look_.fill && textured_; }

  void draw_backdrop(const FaceProjection& t) const {
    const float away = std::max(std::abs(look_.yaw_deg), std::abs(look_.pitch_deg));
    const float opacity =
        std::clamp((kBackdropToDeg - away) / (kBackdropToDeg - kBackdropFromDeg), 0.0F, 1.0F) *
        std::min(birth_.surface, birth_.colours);
    if (backdrop_count_ == 0 || opacity <= 0) return;
    glUseProgram(backdrop_program_);
    glUniformMatrix4fv(glGetUniformLocation(backdrop_program_, "clip_from_head"), 1, GL_FALSE,
                       t.clip_from_model());
    glUniform1f(glGetUniformLocation(backdrop_program_, "opacity"), opacity);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[Behind]);
    point_at({3, kFourBytes});  // a Tinted
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLES, 0, backdrop_count_);
    glDepthMask(GL_TRUE);
  }

  void draw_edges() const {
    glUniform1f(glGetUniformLocation(program_, "edges"), 1);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[Sides]);
    glLineWidth(kEdgeWidthPx * float(times_));
    glDrawElements(GL_LINES, edge_count_, GL_UNSIGNED_INT, nullptr);
  }

  void draw_points(const FaceProjection& t, float opacity, int count, float times) const {
    glUseProgram(point_program_);
    glUniform1f(glGetUniformLocation(point_program_, "opacity"), opacity);
    glUniformMatrix4fv(glGetUniformLocation(point_program_, "clip_from_head"), 1, GL_FALSE,
                       t.clip_from_model());
    glUniform1f(glGetUniformLocation(point_program_, "size"),
                times * std::max(2.0F, float(height_) / 420 * look_.zoom));
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[Points]);
    point_at({3});
    glDrawArrays(GL_POINTS, 0, count);
  }

  enum Buffer : GLsizei { Corners, Indices, Points, Behind, Sides, kBuffers };
  std::array<GLuint, kBuffers> buffers_{};
  GLuint program_ = 0, point_program_ = 0, backdrop_program_ = 0, array_ = 0, texture_ = 0, frame_ = 0,
         colour_ = 0, depth_ = 0;
  std::uint32_t version_ = 0, points_version_ = 0, edges_version_ = 0;
  FaceLook look_;
  Birth birth_ = birth_of(1);
  float covered_ = 0;
  FaceStand stand_;
  float edge_level_mm_ = 0;
  int index_count_ = 0, point_count_ = 0, apart_count_ = 0, backdrop_count_ = 0, edge_count_ = 0, width_ = 0,
      height_ = 0;
  int times_ = 1;  // pixels of the frame for one of the screen
  bool textured_ = false;
};

}  // namespace

Result<std::unique_ptr<FaceView>> FaceView::make() {
  auto view = std::make_unique<GlesFaceView>();
  RELIEVO_TRY(view->prepare());
  return std::unique_ptr<FaceView>(std::move(view));
}

}  // namespace relievo::ui
