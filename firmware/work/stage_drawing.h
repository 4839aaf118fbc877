// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the products of the stages are drawn as the left camera sees them: on a square canvas that shows the
// face, for the visitor's small pictures and the technician's large ones.
// Pixels of the left rectified view go in. Allocates nothing but the depth buffer of a surface and the cells
// of dots. Thread: worker. Errors: none; what is missing stays dark.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/capture/face_light.h"
#include "firmware/machine/machine.h"
#include "firmware/session/session.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::firmware {

struct Rgb {
  double r = 0, g = 0, b = 0;
};

// Near (0) is warm, far (1) is cold.
Rgb near_far_colour(double share);

// side x side pixels, 3 bytes each, borrowed.
class StageCanvas {
 public:
  StageCanvas(std::uint8_t* rgb, int side_px);
  int side() const { return side_; }
  void put(int x, int y, const Rgb& c) {
    if (x >= 0 && y >= 0 && x < side_ && y < side_) put_at(std::ptrdiff_t(y) * side_ + x, c);
  }
  void blend(int x, int y, const Rgb& c, double share);  // over what is there

 private:
  void put_at(std::ptrdiff_t i, const Rgb& c);
  std::uint8_t* rgb_;
  int side_;
};

// The part of the left rectified view that a canvas shows: the face, or all of it where none was looked for.
class FaceWindow {
 public:
  FaceWindow(const pipeline::RectifiedPair& pair, int side_px);
  double x(double px) const { return (px - left_) * canvas_ / side_; }
  double y(double px) const { return (px - top_) * canvas_ / side_; }
  double back_x(double at) const { return left_ + at * side_ / canvas_; }
  double back_y(double at) const { return top_ + at * side_ / canvas_; }

 private:
  double left_ = 0, top_ = 0, side_ = 1, canvas_ = 1;
};

// each(x, y, u, v): every pixel of the canvas with that of the view which it shows; none beyond the view.
template <typename Each>
void for_each_shown(const pipeline::RectifiedPair& pair, const StageCanvas& canvas, const Each& each) {
  const FaceWindow window(pair, canvas.side());
  for (int y = 0; y < canvas.side(); ++y)
    for (int x = 0; x < canvas.side(); ++x) {
      const int u = int(window.back_x(x)), v = int(window.back_y(y));
      if (u >= 0 && v >= 0 && u < pair.width_px && v < pair.height_px) each(x, y, u, v);
    }
}

// The left view, `share` of its brightness.
void draw_photograph(const pipeline::RectifiedPair& pair, double share, StageCanvas& canvas);
// Accepted matches over the photograph, coloured by their depth: as dots, at most one in five pixels each
// way.
void draw_matches(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& set, StageCanvas& canvas);
// The points, drawn as matches are.
void draw_cloud(const pipeline::RectifiedPair& pair, const pipeline::PointCloud& points, StageCanvas& canvas);
// With the skin's colours where they are known, else as clay.
void draw_surface(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh,
                  const pipeline::TextureAtlas* skin, StageCanvas& canvas);
// As clay, in parallel projection: the head as somebody before it sees it
// (pipeline/mesh/landmarks/head_frame.h), turned by so many degrees towards its own left; the surface in the
// middle of the canvas, which is `across_mm` wide.
void draw_head(const pipeline::FaceMesh& mesh, const pipeline::RigidTransform& head_from_camera,
               double turned_deg, double across_mm, StageCanvas& canvas);

// The photograph of the left camera: about the face, or its middle where none was found. Thread: capture.
void draw_capture(const ImageView& picture, const std::optional<FaceBox>& face, StagePictures& pictures);
// What a stage made, drawn small as the left camera sees it: the matches coloured by their depth over
// the photograph, the points, the surface under a lamp, the surface with its colours.
void draw_stage_picture(State stage, const Products& products, StagePictures& pictures);

}  // namespace relievo::firmware
