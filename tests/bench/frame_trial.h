// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One head photographed in many poses: how far the frames found in them lie from each other, once the
// head's true motion between the poses is undone. The true motion is that of head.ply, the true surface.
// A folder a photograph (left.png, right.png, rig.yml, head.ply), named PERSON_POSE.
#pragma once

#include <filesystem>
#include <string>

#include "firmware/measure/measurement.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/model/face_mesh.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {

struct Photograph {
  std::string person, pose;
  pipeline::Vec3d across;  // as the pipeline hands it to the frame's finder
  pipeline::HeadFrame frame;
  firmware::measure::Surface true_surface;  // left camera's frame
};

// Frame b as seen from frame a: zero where the two are the same.
struct Apart {
  double turned_deg = 0;
  pipeline::Vec3d turns_deg;  // about x, y, z
  pipeline::Vec3d origin_mm;
};

std::string person_of(const std::filesystem::path& folder);
std::string pose_of(const std::filesystem::path& folder);

// Errors: those of the readers and of the pipeline.
Result<pipeline::FaceMesh> reconstruct_folder(const std::filesystem::path& folder, test::StageFixture& room,
                                              pipeline::Vec3d& across);

// The rigid motion that takes camera coordinates of b's photograph to a's.
pipeline::RigidTransform a_from_b(const Photograph& a, const Photograph& b);
Apart between(const Photograph& a, const Photograph& b, const pipeline::RigidTransform& a_from_b);

}  // namespace relievo::bench
