// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a model's surface looks like, in clay: from in front and from the side, each 230 mm across.
// Times are left to the caller. Errors: those of the picture encoder. Thread: any.
#pragma once

#include "firmware/measure/comparison.h"
#include "hal/base/result.h"
#include "pipeline/model/face_model.h"

namespace relievo::firmware::compare {

Result<SurfaceLook> surface_look(const pipeline::FaceModel& model);

}  // namespace relievo::firmware::compare
