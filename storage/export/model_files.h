// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files a face model is handed out in: model.ply, model.obj + .mtl + .png, model.glb.
//
// All are written under temporary names and made durable first, then renamed: a failure while
// writing leaves the directory as it was, and an older model.* whole.
// Errors: InvalidInput (the model does not hang together); MediaFull; IoFailed; OutOfMemory.
// Thread: any; blocks on the disk (the keeper, not the screen).
#pragma once

#include <filesystem>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "storage/export/export_mesh.h"

namespace relievo::storage {

// Makes the directory if there is none. Returns the files written, in the order ply, png, mtl, obj,
// glb; without a texture there is no png.
Result<std::vector<std::filesystem::path>> write_model_files(const pipeline::FaceModel& model,
                                                             const std::filesystem::path& dir,
                                                             ExportFrame frame);

}  // namespace relievo::storage
