// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/recognition/recognition_images.h"

#include <new>

#include "pipeline/recognition/portrait.h"
#include "pipeline/recognition/range_image.h"

namespace relievo::pipeline {

Result<RecognitionImages> make_recognition_images(const FaceModel& model, std::pmr::memory_resource& output,
                                                  std::pmr::memory_resource& scratch) {
  if (model.mesh.triangles.empty()) return Error{Errc::InvalidInput, "there is no surface to draw"};
  try {
    RecognitionImages images(&output);
    images.portrait = draw_portrait(model, &output, &scratch);
    images.range = measure_range(model.mesh, model.head_from_camera, {}, &output, &scratch);
    return images;
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory for the portrait and the range image"};
  }
}

}  // namespace relievo::pipeline
