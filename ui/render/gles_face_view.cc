// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GLES3/gl3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ui/render/face_geometry.h"
#include "ui/render/gles_program.h"
#include "ui/render/renderer.h"

namespace relievo::ui {
namespace {

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
    RELIEVO_TRY_ASSIGN(program_, compile_program(shader::kFaceVertex, shader::kFace));
    RELIEVO_TRY_ASSIGN(point_program_, compile_program(shader::kPointVertex, shader::kPoint));
    RELIEVO_TRY_ASSIGN(backdrop_program_, compile_program(shader::kBackdropVertex, shader::kBackdrop));
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
    glDeleteBuffers(1, &buffer_);
    glDeleteBuffers(1, &index_buffer_);
    glDeleteBuffers(1, &point_buffer_);
    glDeleteBuffers(1, &backdrop_buffer_);
    glDeleteBuffers(1, &edge_buffer_);
    glDeleteTextures(1, &texture_);
    glDeleteTextures(1, &colour_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteFramebuffers(1, &frame_);
    buffer_ = index_buffer_ = point_buffer_ = backdrop_buffer_ = edge_buffer_ = texture_ = colour_ = depth_ =
        frame_ = 0;
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
    fill(GL_ARRAY_BUFFER, buffer_, corners_of(model, split));
    glBindVertexArray(array_);  // which keeps the buffer of indices
    fill(GL_ELEMENT_ARRAY_BUFFER, index_buffer_, split.triangles);
    const std::vector<Tinted> behind = tinted_of(model);
    backdrop_count_ = int(behind.size());
    fill(GL_ARRAY_BUFFER, backdrop_buffer_, behind);
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
    fill(GL_ARRAY_BUFFER, point_buffer_, dots);
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
    fill(GL_ELEMENT_ARRAY_BUFFER, edge_buffer_, indices);
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
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
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
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_);
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
    glBindBuffer(GL_ARRAY_BUFFER, backdrop_buffer_);
    point_at({3, kFourBytes});  // a Tinted
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLES, 0, backdrop_count_);
    glDepthMask(GL_TRUE);
  }

  void draw_edges() const {
    glUniform1f(glGetUniformLocation(program_, "edges"), 1);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, edge_buffer_);
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
    glBindBuffer(GL_ARRAY_BUFFER, point_buffer_);
    point_at({3});
    glDrawArrays(GL_POINTS, 0, count);
  }

  GLuint program_ = 0, point_program_ = 0, backdrop_program_ = 0, backdrop_buffer_ = 0, edge_buffer_ = 0,
         array_ = 0, buffer_ = 0, index_buffer_ = 0, point_buffer_ = 0, texture_ = 0, frame_ = 0, colour_ = 0,
         depth_ = 0;
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
