// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Artefacts of an acceptance test: a dumbbell of two matt spheres on a rod, and a flat plate, both
// printed with a random speckle (speckle.h), before a dark room. Exact: no triangles where rays meet.
// Artefact frame: origin in the middle, x along the rod or the plate's width, y along its height,
// z into the plate; mm. World and units: rig.h.
// Thread: any number at once.
#pragma once

#include <cstdint>

#include "hal/base/result.h"
#include "hal/sim/base/vec3.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

struct ArtefactPose {
  Mat3 world_from_artefact;
  Vec3 origin_mm;  // of the artefact, in world
  Vec3 to_world(Vec3 p) const { return world_from_artefact * p + origin_mm; }
  Vec3 to_artefact(Vec3 p) const { return world_from_artefact.transposed() * (p - origin_mm); }
};

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

class DumbbellScene final : public Scene {
 public:
  DumbbellScene(const Dumbbell& dumbbell, const ArtefactPose& pose) : dumbbell_(dumbbell), pose_(pose) {}
  RayHit look(Vec3 origin, Vec3 direction) const override;
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override;  // skin: the spheres
  bool blocked(Vec3 from, Vec3 direction, double far_mm) const override;
  Mesh solid_mesh() const override;  // the spheres
  Vec3 centre_mm(int sphere) const;  // 0 at -x, 1 at +x; in world

 private:
  enum class Part : std::int8_t { None, Sphere, Rod };
  Part meet(Vec3 o, Vec3 d, double& distance, Vec3& normal) const;  // artefact frame
  Dumbbell dumbbell_;
  ArtefactPose pose_;
};

class PlateScene final : public Scene {
 public:
  PlateScene(const FlatPlate& plate, const ArtefactPose& pose) : plate_(plate), pose_(pose) {}
  RayHit look(Vec3 origin, Vec3 direction) const override;
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override;
  bool blocked(Vec3, Vec3, double) const override { return false; }
  Mesh solid_mesh() const override;

 private:
  bool meet(Vec3 o, Vec3 d, double& distance) const;
  FlatPlate plate_;
  ArtefactPose pose_;
};

}  // namespace relievo::hal::sim
