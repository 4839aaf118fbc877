// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianPictures: what every stage made of a test capture, drawn large for the technician. Rgb8, no side
// longer than budget::kTechnicianPictureSidePx, in memory of fixed size; pages nobody touched cost nothing.
//   Input, Processed, Rectified   both views, whole
//   Matches                       the face: rejected ones in the colour of the rule that took them first
//   Disparity, Cloud, Mesh, Texture   the face; beside the mesh what pairs by hand changed, where there are
//   any
//   Poses   of a head from several pairs: a photograph each, and how far its surface lies before the others'
// Thread: the worker draws while its job runs; main reads and wipes while none runs. No errors.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/measure/comparison.h"
#include "firmware/session/session.h"
#include "firmware/work/session_document.h"
#include "firmware/work/stage_drawing.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/stage.h"
#include "pipeline/fuse/head_pipeline.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// SurfaceDifference: how far one surface lies before another, both as the left rectified view sees them: a
// map, its median and the bound of 95 %, and colours for the surface itself. Depths along the view's z,
// millimetres; positive where it is nearer. Thread: measure() and draw() worker, else main, never at once.
// Errors: none; where one of the two is not there nothing is known.

// What the left rectified view sees of a mesh: depths, NaN where there is none.
compare::DisparityMap depths_of(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh);

// Paints every pixel of the canvas as colour(x, y) says of the view's pixel that it shows, where it says
// anything (std::optional); nothing beyond the view.
template <typename Colour>
void paint(const pipeline::RectifiedPair& pair, StageCanvas& canvas, Colour&& colour) {
  for_each_shown(pair, canvas, [&](int x, int y, int u, int v) {
    const std::optional<std::array<std::uint8_t, 3>> c = colour(u, v);
    if (c) canvas.put(x, y, {1.0 * (*c)[0], 1.0 * (*c)[1], 1.0 * (*c)[2]});
  });
}

// The left view, and on it by how much a surface came nearer (mm at a pixel of it; NaN: not known, the
// photograph stays), in colours whose scale ends at `full_colour_mm`.
void draw_nearer(const pipeline::RectifiedPair& pair, const std::function<float(int x, int y)>& nearer_mm,
                 float full_colour_mm, StageCanvas& canvas);

// From farther to nearer, at equal steps.
std::span<const std::array<std::uint8_t, 3>> difference_scale();

class SurfaceDifference {
 public:
  // Of `surface` to `other`; `number` is the coloured surface's from now on.
  void measure(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& surface,
               const compare::DisparityMap& other, std::uint32_t number);
  // Map and colours, where `full_colour_mm` is the end of the scale.
  void draw(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& surface, float full_colour_mm);
  void forget() { *this = {}; }

  float nearer_mm(int x, int y) const {
    return nearer_.holds(x, y) ? nearer_.at(x, y) : std::numeric_limits<float>::quiet_NaN();
  }
  ui::TechnicianDifference view() const;

 private:
  compare::DisparityMap nearer_;
  std::vector<std::uint8_t> rgb_;
  pipeline::TextureAtlas colours_{std::pmr::get_default_resource()};
  ui::TechnicianDifference figures_;
};

// HandChange: the surface with the pairs made by hand against that of the same capture and the same
// algorithms without any, both as the left rectified view sees them. Depths along its z, millimetres. Thread:
// worker while a job runs, else main. Errors: none; without the other surface nothing is known.
class HandChange {
 public:
  // The surface without pairs is there.
  bool has_before(const pipeline::AlgorithmSet& set) const { return !set_.empty() && set_ == set.to_text(); }
  void before(const pipeline::AlgorithmSet& set, const pipeline::RectifiedPair& pair,
              const pipeline::FaceMesh& mesh);
  // With pairs; does nothing for a surface without any but keeping it as the one before.
  void measure(const Making& making, const Products& products);
  void forget() { *this = {}; }

  const ui::TechnicianChange& figures() const { return figures_; }
  // By how much the surface came nearer at a place of the view; NaN where one of the two is not there.
  float nearer_mm(int x, int y) const;
  // To the points of the pairs that were calculated with.
  void tell(std::span<ui::TechnicianPoint> points) const;

 private:
  compare::DisparityMap before_, now_;  // depths
  std::string set_;                     // the algorithms of `before_`
  ui::TechnicianChange figures_;
};

// The ends of the scale in which residuals are drawn.
float full_residual_mm(const pipeline::Registration& registration);

class TechnicianPictures {
 public:
  static constexpr int kSide = budget::kTechnicianPictureSidePx;

  // Of what is put aside, the left ones alone are kept.
  explicit TechnicianPictures(bool right_too = true);
  // Draws what the products have.
  void draw(const Products& products, const HandChange& change);
  // Of a head: what its poses were measured as.
  void draw_poses(const Products& products, std::span<const pipeline::HeadPose> poses);
  // The left picture (0) or the right one; empty where the stage has none.
  ui::Picture picture(ui::TechnicianStage stage, std::size_t side) const;
  // The left ones.
  void copy_from(const TechnicianPictures& other);
  void wipe();

 private:
  struct One {
    std::uint8_t* rgb = nullptr;  // in block_
    int width_px = 0, height_px = 0;
    std::uint32_t version = 0;  // 0: none
  };
  // No larger than kSide.
  One& begin(ui::TechnicianStage stage, std::size_t side, int width_px = kSide, int height_px = kSide);
  void draw_pair(ui::TechnicianStage stage, const pipeline::RectifiedPair& pair, bool colour);
  void draw_input(const ImageView& view, std::size_t side);
  void draw_rules(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches);
  void draw_disparity(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches);
  void draw_shapes(const Products& products);

  PageBlock block_;
  std::array<std::array<One, 2>, ui::kTechnicianStages> all_;
};

}  // namespace relievo::firmware
