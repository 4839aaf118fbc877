// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What may stand beside a model's files: a lighter model (light.*), a solid for printing (solid.*). Each
// leaves a line that says what it is. Errors: those of lighten(), make_solid() and the files, with `place`
// for what the caller was asked for; Cancelled, of a solid. That takes memory of its own while it is made
// (budget::kSolidBytes). Thread: any.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "storage/export/format/export_mesh.h"

namespace relievo::firmware {

Result<std::vector<std::string>> write_further_models(
    const pipeline::FaceModel& model, const FurtherModels& wanted, const std::filesystem::path& folder,
    storage::ExportFrame frame, const std::filesystem::path& place, const std::atomic<bool>& cancelled);

}  // namespace relievo::firmware
