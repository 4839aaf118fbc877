// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a visit's pictures to a face that can be compared: rectify, match, reconstruct, mesh (kept as
// mesh.bin), head frame, rigid part. Errors: those of the pipeline. Thread: one caller; uses the room's pool.
#pragma once

#include <filesystem>

#include "tests/bench/recognition/mesh_file.h"
#include "tests/support/recognition/face_comparison.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {

// The surface alone, in the room's output.
Result<SeenSurface> surface_of(const std::filesystem::path& folder, test::StageFixture& room);

Result<pipeline::ComparableFace> enrol(const std::filesystem::path& folder, test::StageFixture& room);

}  // namespace relievo::bench
