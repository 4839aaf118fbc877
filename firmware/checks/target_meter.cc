// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/checks/target_meter.h"

#include <cmath>

#include "firmware/checks/deviation_picture.h"
#include "firmware/jobs/pool_size.h"

namespace relievo::firmware {

using pipeline::Vec3d;

struct TargetMeter::Room {
  Room(pipeline::Pipeline stages, const std::atomic<bool>& cancelled)
      : memory(0, budget::kOutputArenaBytes, budget::kScratchArenaBytes),
        output(memory.output()),
        scratch(memory.scratch()),
        pool(pool_size()),
        context{output, scratch, pool, progress, cancelled},
        pipeline(std::move(stages)) {}
  BootMemory memory;
  Arena output, scratch;
  ThreadPool pool;
  pipeline::Progress progress;
  pipeline::StageContext context;
  pipeline::Pipeline pipeline;
  std::optional<pipeline::RectifiedPair> pair;
};

TargetMeter::TargetMeter() = default;
TargetMeter::TargetMeter(TargetMeter&&) noexcept = default;
TargetMeter::~TargetMeter() = default;

Result<TargetMeter> TargetMeter::make(const pipeline::StereoCalibration& calibration,
                                      const std::atomic<bool>& cancelled) {
  pipeline::AlgorithmSet set;
  RELIEVO_TRY(set.set("preprocessor", "none"));      // a target is no skin
  RELIEVO_TRY(set.set("grid.min_area_mm2", "300"));  // a sphere of 20 mm, seen within 60 degrees
  RELIEVO_TRY_ASSIGN(auto stages, pipeline::Pipeline::make(set, calibration, {}, pipeline::Region::All));
  TargetMeter meter;
  meter.room_ = std::make_unique<Room>(std::move(stages), cancelled);
  return meter;
}

Result<void> TargetMeter::take(const TargetPictures& pictures) {
  room_->pair.reset();
  room_->output.reset();
  RELIEVO_TRY_ASSIGN(room_->pair,
                     room_->pipeline.rectify({pictures.left.view(), pictures.right.view()}, room_->context));
  return {};
}

TargetMeter::Circle TargetMeter::circle_around(const Vec3d& centre_mm, double reach_mm) const {
  const pipeline::RectifiedPair& pair = *room_->pair;
  const Vec3d c = apply(pair.rectified_from_left, centre_mm);
  const double scale = pair.focal_px / c.z;
  return {scale * c.x + pair.left_centre_px.x, scale * c.y + pair.left_centre_px.y, scale * reach_mm};
}

Result<std::vector<Vec3d>> TargetMeter::surface_around(const Vec3d& centre_mm, double reach_mm) {
  Room& room = *room_;
  pipeline::RectifiedPair& pair = *room.pair;
  const Circle circle = circle_around(centre_mm, reach_mm);
  const auto width = static_cast<std::size_t>(pair.width_px);
  pair.region.resize(width * static_cast<std::size_t>(pair.height_px));
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x)
      pair.region[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
          std::hypot(x - circle.x_px, y - circle.y_px) < circle.radius_px ? 1 : 0;
  const Arena::Mark mark(room.output);  // the pair stays for the target's other parts
  RELIEVO_TRY_ASSIGN(const auto matches, room.pipeline.match(pair, room.context));
  RELIEVO_TRY_ASSIGN(const auto cloud, room.pipeline.reconstruct(pair, matches, room.context));
  RELIEVO_TRY_ASSIGN(const auto mesh, room.pipeline.mesh(cloud, pair, room.context));
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    if (mesh.measured[i] != 0) points.push_back(wide(mesh.vertices_mm[i]));
  return points;
}

hal::Picture TargetMeter::picture_of(const Vec3d& centre_mm, double reach_mm,
                                     const std::vector<Vec3d>& points_mm,
                                     const std::vector<double>& deviations_mm, double range_mm) const {
  const pipeline::RectifiedPair& pair = *room_->pair;
  const Circle circle = circle_around(centre_mm, reach_mm);
  DeviationPicture picture(
      pair.left.rgb, pair.width_px, pair.height_px,
      {static_cast<int>(circle.x_px - circle.radius_px), static_cast<int>(circle.y_px - circle.radius_px),
       static_cast<int>(circle.x_px + circle.radius_px), static_cast<int>(circle.y_px + circle.radius_px)});
  for (std::size_t i = 0; i < points_mm.size(); ++i) {
    const Vec3d p = apply(pair.rectified_from_left, points_mm[i]);
    picture.mark(pair.focal_px * p.x / p.z + pair.left_centre_px.x,
                 pair.focal_px * p.y / p.z + pair.left_centre_px.y, deviations_mm[i] / range_mm);
  }
  return picture.finish();
}

}  // namespace relievo::firmware
