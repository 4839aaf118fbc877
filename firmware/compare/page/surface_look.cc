// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/page/surface_look.h"

#include <algorithm>

#include "firmware/work/stage_drawing.h"
#include "hal/picture_file.h"

namespace relievo::firmware::compare {
namespace {

constexpr int kSidePx = 420;
constexpr double kAcrossMm = 230, kTurnedDeg = 50;

Result<std::vector<std::byte>> head_picture(const pipeline::FaceModel& model, double turned_deg) {
  std::vector<std::uint8_t> rgb(std::size_t{3} * kSidePx * kSidePx);
  StageCanvas canvas(rgb.data(), kSidePx);
  draw_head(model.mesh, model.head_from_camera, turned_deg, kAcrossMm, canvas);
  return hal::encode_png(
      {reinterpret_cast<const std::byte*>(rgb.data()), kSidePx, kSidePx, 3 * kSidePx, PixelFormat::Rgb8});
}

}  // namespace

Result<SurfaceLook> surface_look(const pipeline::FaceModel& model) {
  SurfaceLook look;
  look.vertices = model.mesh.vertices_mm.size();
  look.measured =
      static_cast<std::size_t>(std::count(model.mesh.measured.begin(), model.mesh.measured.end(), 1));
  look.triangles = model.mesh.triangles.size();
  RELIEVO_TRY_ASSIGN(look.front, head_picture(model, 0));
  RELIEVO_TRY_ASSIGN(look.side, head_picture(model, kTurnedDeg));
  return look;
}

}  // namespace relievo::firmware::compare
