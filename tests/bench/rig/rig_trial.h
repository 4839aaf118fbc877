// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One trial of the sweep: one rig, one person, one pose, photographed and reconstructed by the whole
// chain with default algorithms, and compared with the person's true surface. Calibrated by the rig's
// truth, so that rigs differ by their geometry only.
//
// The face is what a frontal viewer sees of the skin within 95 mm of the nose: the same surface for
// every rig. Errors are perpendicular to it, mm. Shares are of its area.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/rig.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {

struct RigUnderTest {
  bool portrait = false;
  double baseline_mm = 110;
  double focal_px = 2320;    // of a picture of 1920 x 1200
  double distance_mm = 560;  // from the middle between the cameras to the face
  double toe_in = 1;         // 1: the axes meet at that distance; 0: parallel; 2: at half of it
};

// Away from the place the rig looks at, and from looking straight at its middle.
struct Stand {
  double right_mm = 0, down_mm = 0, back_mm = 0;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

struct TrialResult {
  bool done = false;                 // the chain gave a surface
  std::string why{};                 // it did not
  double median_mm = 0, p95_mm = 0;  // of what both cameras see and the chain measured
  double seen_by_both = 0;
  double within_half_mm = 0;  // measured, and right to 0.5 mm
  double matched = 0;         // share of what both see that got a surface within 3 mm
};

// A person, prepared once: geometry, and samples of the face spread evenly over its area.
struct Person {
  std::shared_ptr<const hal::sim::HeadModel> head;
  struct Sample {
    hal::sim::Vec3 at_mm, normal;  // head frame
    double area = 0;
  };
  std::vector<Sample> face;
  // The head before a frontal viewer: what hides what is the same in every pose.
  hal::sim::HeadPose frontal;
  std::shared_ptr<const hal::sim::Scene> scene;
};

Person make_person(std::uint32_t seed, ThreadPool& pool);

// Fills seen_by_both only.
TrialResult look_at(const RigUnderTest& rig, const Person& person, const Stand& stand, std::uint32_t seed);

TrialResult run_trial(const RigUnderTest& rig, const Person& person, const Stand& stand, std::uint32_t seed,
                      double scale, test::StageFixture& room);

}  // namespace relievo::bench
