// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SurfaceDifference: how far one surface lies before another, both as the left rectified view sees them: a
// map, its median and the bound of 95 %, and colours for the surface itself. Depths along the view's z,
// millimetres; positive where it is nearer. Thread: measure() and draw() worker, else main, never at once.
// Errors: none; where one of the two is not there nothing is known.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "firmware/measure/disparity_map.h"
#include "firmware/work/stage_drawing.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

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

}  // namespace relievo::firmware
