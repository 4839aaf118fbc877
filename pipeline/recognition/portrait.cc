// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/recognition/portrait.h"

#include <cmath>

#include "pipeline/recognition/textured_view.h"

namespace relievo::pipeline {
namespace {

constexpr int kWidthPx = 840;
constexpr int kHeightPx = 1080;
constexpr double kMmPerPx = 0.3;
constexpr double kCameraMm = 1500;
constexpr double kEyeLine = 0.45;  // of the height, from above
// From the tip of the nose, where eyes were not found; faces differ by some millimetres.
constexpr Vec3d kTypicalEyesMm{0, 34, -30};

struct Eyes {
  Vec3d right_mm, left_mm;
  bool found;
};

// The middle of each eye from its corners; a corner that was not found is the other side's mirror image.
Eyes eyes_of(const FaceModel& model) {
  Eyes eyes{{}, {}, true};
  const auto corner = [&](LandmarkName name, LandmarkName mirrored) {
    const bool own = of(model.landmarks, name).found;
    const Landmark& l = of(model.landmarks, own ? name : mirrored);
    eyes.found = eyes.found && l.found;
    Vec3d at =
        apply(model.head_from_camera, Vec3d{static_cast<double>(l.at_mm.x), static_cast<double>(l.at_mm.y),
                                            static_cast<double>(l.at_mm.z)});
    if (!own) at.x = -at.x;
    return at;
  };
  const auto middle = [](const Vec3d& a, const Vec3d& b) {
    return Vec3d{0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
  };
  using enum LandmarkName;
  eyes.right_mm =
      middle(corner(EndocanthionRight, EndocanthionLeft), corner(ExocanthionRight, ExocanthionLeft));
  eyes.left_mm =
      middle(corner(EndocanthionLeft, EndocanthionRight), corner(ExocanthionLeft, ExocanthionRight));
  return eyes;
}

}  // namespace

Portrait draw_portrait(const FaceModel& model, std::pmr::memory_resource* output,
                       std::pmr::memory_resource* scratch) {
  Portrait portrait(output);
  portrait.width_px = kWidthPx;
  portrait.height_px = kHeightPx;
  portrait.mm_per_px = kMmPerPx;
  portrait.camera_mm = kCameraMm;
  portrait.eyes_mm = kTypicalEyesMm;
  portrait.eyes_px = {(kWidthPx - 1) / 2.0, kEyeLine * kHeightPx};
  if (const Eyes eyes = eyes_of(model); eyes.found) {
    const Vec3d &r = eyes.right_mm, &l = eyes.left_mm;
    portrait.eyes_mm = {0.5 * (r.x + l.x), 0.5 * (r.y + l.y), 0.5 * (r.z + l.z)};
    portrait.between_eyes_mm = std::hypot(l.x - r.x, l.y - r.y, l.z - r.z);
    portrait.right_eye_px = portrait.place_of(r);
    portrait.left_eye_px = portrait.place_of(l);
  }

  ViewCamera camera;
  camera.width_px = kWidthPx;
  camera.height_px = kHeightPx;
  camera.focal_px = kCameraMm / kMmPerPx;
  camera.centre_px = portrait.eyes_px;
  // x stays, y and z turn: the camera looks along the head's -z and counts rows downwards.
  const RigidTransform& head = model.head_from_camera;
  for (int i = 0; i < 9; ++i) camera.view_from_camera.rotation.m[i] = (i < 3 ? 1 : -1) * head.rotation.m[i];
  camera.view_from_camera.translation_mm = {head.translation_mm.x - portrait.eyes_mm.x,
                                            -(head.translation_mm.y - portrait.eyes_mm.y),
                                            -(head.translation_mm.z - portrait.eyes_mm.z) + kCameraMm};
  TexturedView view = draw_textured(model.mesh, model.texture, camera, output, scratch);
  portrait.rgb = std::move(view.rgb);
  portrait.shows = std::move(view.shows);
  return portrait;
}

}  // namespace relievo::pipeline
