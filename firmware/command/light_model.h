// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lighter model beside a model's files: light.ply, .obj, .glb, and the line that says what it cost.
// Errors: those of lighten() and of the files, with `place` for what the caller was asked for. Thread: main.
#pragma once

#include <filesystem>
#include <string>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "storage/export/format/export_mesh.h"

namespace relievo::firmware {

Result<std::string> write_light_model(const pipeline::FaceModel& model, int triangles,
                                      const std::filesystem::path& folder, storage::ExportFrame frame,
                                      const std::filesystem::path& place);

}  // namespace relievo::firmware
