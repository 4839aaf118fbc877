// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The finished face as recognition programs want it: the fifth product, beside the model.
// Products lie in `output`, the rest in `scratch`. Errors: InvalidInput (a model without surface),
// OutOfMemory. Thread: any; the same for the same model, always.
#pragma once

#include "hal/base/arena.h"
#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::pipeline {

Result<RecognitionImages> make_recognition_images(const FaceModel& model, std::pmr::memory_resource& output,
                                                  std::pmr::memory_resource& scratch);

}  // namespace relievo::pipeline
