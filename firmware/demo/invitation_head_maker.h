// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the head of the page that invites (firmware/kiosk/invitation_head.h) from a model: a lighter form of
// it, as two files in the folder, which must exist. Errors: IoFailed, those of the picture file. Thread:
// main.
#pragma once

#include <filesystem>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"

namespace relievo::firmware {

Result<void> make_invitation_head(const pipeline::FaceModel& model, const std::filesystem::path& folder);

}  // namespace relievo::firmware
