// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A person in front of the rig: a head of our own making (head_traits.h), lit by two soft panels.
// The seed is the person; the pose is how they stand. Building takes seconds and both threads.
#pragma once

#include <memory>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

struct HeadPose {
  double yaw_deg = 0;    // + turns the face to the picture's right
  double pitch_deg = 0;  // + looks down
  double roll_deg = 0;
  double distance_mm = 560;  // left camera to the middle of the face, along its axis
  double right_mm = 0, down_mm = 0;
  bool eyes_follow = true;  // the cameras, as far as eyes turn; painted ones look straight ahead
  Mat3 world_from_head() const;
  Vec3 origin_mm() const;  // of the head frame, in world
};

// The same head, turned about its neck.
HeadPose turned_about_neck(HeadPose pose, double yaw_deg);

class HeadModel;  // one person's geometry, reusable in any pose

std::shared_ptr<const HeadModel> make_head(const HeadTraits& traits, ThreadPool& pool);

std::unique_ptr<Scene> make_head_scene(std::shared_ptr<const HeadModel> head, const HeadPose& pose,
                                       ThreadPool& pool, const HeadLighting& lighting = {});

}  // namespace relievo::hal::sim
