// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of calibration boards and acceptance artefacts, as the simulated rig takes them: a dumbbell of two
// matt spheres on a rod, and a flat plate, both printed with a random speckle, before a dark room. Exact: no
// triangles where rays meet. The same numbers give the same pictures.
// Artefact frame: origin in the middle, x along the rod or the plate's width, y along its height, z into the
// plate; mm. World and units: rig.h.
// Thread: any; photographs make `threads` - 1 of their own meanwhile.
// Errors: InvalidInput, PoorGeometry (the rig does not see the whole target).
#pragma once

#include <cstdint>

#include "hal/base/result.h"
#include "hal/sim/base/vec3.h"
#include "hal/sim/optics/scene.h"
#include "hal/sim/render.h"

namespace relievo::hal::sim {

// A random speckle as artefacts for passive stereo carry it: dark dots on matt white, in three sizes,
// so that small pictures of it still have something to match. A field over space: where a surface cuts it
// the dots lie on the surface without seams.
double speckle(Vec3 p_mm, std::uint32_t seed);  // reflectance, 0.06 .. 0.8

struct Dumbbell {
  double diameter_mm = 60;  // of both spheres
  double spacing_mm = 120;  // between their centres
  double rod_radius_mm = 4;
  std::uint32_t seed = 1;      // of the speckle
  Result<void> check() const;  // InvalidInput
};

struct FlatPlate {
  double width_mm = 240, height_mm = 180;
  std::uint32_t seed = 1;
  Result<void> check() const;  // InvalidInput
};

class ArtefactScene : public Scene {
 public:
  ArtefactScene(const BodyPose& pose, std::uint32_t seed) : pose_(pose), seed_(seed) {}
  RayHit look(Vec3 origin, Vec3 direction) const override;
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override;  // skin: what is printed
  bool blocked(Vec3 from, Vec3 direction, double far_mm) const override;

 protected:
  struct Met {
    double distance = RayCaster::kFar;
    Vec3 normal;
    std::int32_t body = -1;
    bool printed = false;
  };
  virtual Met meet(Vec3 o, Vec3 d) const = 0;  // artefact frame
  BodyPose pose_;

 private:
  Met met_from(Vec3 origin, Vec3 direction) const;  // in world, but for the normal
  std::uint32_t seed_;
};

class DumbbellScene final : public ArtefactScene {
 public:
  DumbbellScene(const Dumbbell& dumbbell, const BodyPose& pose)
      : ArtefactScene(pose, dumbbell.seed), dumbbell_(dumbbell) {}
  Vec3 centre_mm(int sphere) const;  // 0 at -x, 1 at +x; in world

 private:
  Met meet(Vec3 o, Vec3 d) const override;
  Dumbbell dumbbell_;
};

class PlateScene final : public ArtefactScene {
 public:
  PlateScene(const FlatPlate& plate, const BodyPose& pose) : ArtefactScene(pose, plate.seed), plate_(plate) {}
  bool blocked(Vec3, Vec3, double) const override { return false; }

 private:
  Met meet(Vec3 o, Vec3 d) const override;
  FlatPlate plate_;
};

struct TargetPhotoOptions {
  RigOptions rig;
  SensorOptions sensor;
  std::uint32_t seed = 1;  // of the noise, and of the boards' poses
  int threads = 2;
};

// Where an artefact stands: its middle in the left camera's frame, turned about x, then y, then z.
struct ArtefactPlace {
  double right_mm = 0, down_mm = 0, distance_mm = 560;
  double pitch_deg = 0, yaw_deg = 0, roll_deg = 0;
  BodyPose pose() const;
};

// The `number`th of `count` boards in good poses (good_board_poses), in grey.
Result<PicturePair> photograph_board(const TargetPhotoOptions& options, const BoardPattern& board, int number,
                                     int count);
Result<PicturePair> photograph_dumbbell(const TargetPhotoOptions& options, const Dumbbell& dumbbell,
                                        const ArtefactPlace& place);
Result<PicturePair> photograph_plate(const TargetPhotoOptions& options, const FlatPlate& plate,
                                     const ArtefactPlace& place);

}  // namespace relievo::hal::sim
