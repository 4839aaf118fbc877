// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/target/target_photo.h"

namespace relievo::hal::sim {
namespace {

const Error kCut{
    Errc::PoorGeometry,
    "the simulated rig does not see the whole target: put it nearer to the middle, or further away"};

bool seen(const SimView& view, Vec3 p, double reach_mm) {
  const double depth = view.depth_mm(p);
  if (depth < 50) return false;
  const Pixel q = view.project(p);
  const double edge = 4 + view.fx_px * reach_mm / depth;
  return q.x > edge && q.y > edge && q.x < view.width_px - 1 - edge && q.y < view.height_px - 1 - edge;
}

bool seen(const SimRig& rig, Vec3 p, double reach_mm) {
  return seen(rig.left, p, reach_mm) && seen(rig.right, p, reach_mm);
}

PicturePair take(const Scene& scene, const SimRig& rig, const TargetPhotoOptions& options,
                 std::uint64_t noise) {
  ThreadPool pool(options.threads);
  return render_pair(scene, rig, options.sensor, options.seed * 100000ULL + noise, pool);
}

// Two places never share their noise.
std::uint64_t noise_of(const ArtefactPlace& p) {
  std::uint64_t h = 1;
  for (const double v : {p.right_mm, p.down_mm, p.distance_mm, p.pitch_deg, p.yaw_deg, p.roll_deg})
    h = h * 1000003 + static_cast<std::uint64_t>(std::llround(v * 100) + 100'000'000);
  return 1000 + h % 90000;
}

}  // namespace

ArtefactPose ArtefactPlace::pose() const {
  return {rotation(radians(pitch_deg), radians(yaw_deg), radians(roll_deg)),
          {right_mm, down_mm, distance_mm}};
}

Result<PicturePair> photograph_board(const TargetPhotoOptions& options, const BoardPattern& board, int number,
                                     int count) {
  RELIEVO_TRY(options.rig.check());
  const SimRig rig = make_rig(options.rig);
  RELIEVO_TRY_ASSIGN(const auto poses, good_board_poses(rig, board, count, options.seed));
  if (number < 0 || number >= count)
    return Error{Errc::InvalidInput, "there is no board of this number in the series"};
  TargetPhotoOptions grey = options;
  grey.sensor.grey = true;
  return take(BoardScene(board, poses[static_cast<std::size_t>(number)]), rig, grey,
              static_cast<std::uint64_t>(number));
}

Result<PicturePair> photograph_dumbbell(const TargetPhotoOptions& options, const Dumbbell& dumbbell,
                                        const ArtefactPlace& place) {
  RELIEVO_TRY(options.rig.check());
  RELIEVO_TRY(dumbbell.check());
  const SimRig rig = make_rig(options.rig);
  const DumbbellScene scene(dumbbell, place.pose());
  for (const int side : {0, 1})
    if (!seen(rig, scene.centre_mm(side), dumbbell.diameter_mm / 2)) return kCut;
  return take(scene, rig, options, noise_of(place));
}

Result<PicturePair> photograph_plate(const TargetPhotoOptions& options, const FlatPlate& plate,
                                     const ArtefactPlace& place) {
  RELIEVO_TRY(options.rig.check());
  RELIEVO_TRY(plate.check());
  const SimRig rig = make_rig(options.rig);
  const ArtefactPose pose = place.pose();
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      if (!seen(rig, pose.to_world({x * plate.width_mm, y * plate.height_mm, 0}), 0)) return kCut;
  return take(PlateScene(plate, pose), rig, options, noise_of(place));
}

}  // namespace relievo::hal::sim
