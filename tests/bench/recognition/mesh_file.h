// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface of a visit as the pipeline left it (mesh.bin beside the pictures), so that a proof that was
// stopped goes on, and so that frames and comparisons can be tried again without matching again. For this
// machine's own use: not a file to hand on. Errors: NotFound, InvalidInput, IoFailed. Thread: any.
#pragma once

#include <filesystem>
#include <memory_resource>

#include "hal/base/result.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::bench {

struct SeenSurface {
  explicit SeenSurface(std::pmr::memory_resource* memory) : mesh(memory) {}
  pipeline::FaceMesh mesh;
  pipeline::Vec3d across;  // from the left camera to the right one, as the frame's finder takes it
};

Result<void> write_surface(const std::filesystem::path& file, const SeenSurface& surface);
Result<SeenSurface> read_surface(const std::filesystem::path& file, std::pmr::memory_resource* memory);

}  // namespace relievo::bench
