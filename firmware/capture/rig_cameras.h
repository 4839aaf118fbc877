// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which two cameras these are, and whether they are the ones a calibration was made with. A serial number
// tells a camera wherever it is plugged in; without one, or with the same one on both, it is told by its
// socket: that an equal camera was put there is then not seen. What a camera says of itself is untrusted: it
// is kept as printable ASCII, and its end where it is long. Thread: any, while no other opens the cameras.
#pragma once

#include "hal/base/result.h"
#include "hal/camera.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware {

// After both were opened. Empty of a camera that tells nothing of itself.
pipeline::RigCameras cameras_of(const hal::Camera& left, const hal::Camera& right);

// NotCalibrated: another camera, or the two exchanged; the sentence says which and what to do, where() what
// was expected and what is there. A side of which nothing is known says nothing.
Result<void> check_cameras(const pipeline::RigCameras& calibrated, const pipeline::RigCameras& found);

}  // namespace relievo::firmware
