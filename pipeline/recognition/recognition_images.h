// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The finished face as recognition programs want it: the fifth product, beside the model.
// Products lie in `output`, the rest in `scratch`. Errors: InvalidInput (a model without surface),
// OutOfMemory. Thread: any; the same for the same model, always.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "hal/base/arena.h"
#include "hal/base/result.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::pipeline {

// A surface as heights over a fixed grid of the head frame, as face recognition from range images takes
// it (Bowyer, Chang, Flynn: A survey of approaches and challenges in 3D and multi-modal 3D + 2D face
// recognition, CVIU 2006): 401 x 501 pixels of 0.5 mm, x from -100 to 100, y from 130 down to -120. Exact on
// the triangles: a pixel is a ray along -z through its centre. Surface seen from behind or at more than 85
// degrees has no height worth keeping. Throws std::bad_alloc.
RangeImage measure_range(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                         std::pmr::memory_resource* output, std::pmr::memory_resource* scratch);

// The frontal portrait, laid out as ISO/IEC 39794-5:2019, annex D, and ICAO Doc 9303-3 ask of a
// passport photograph: 7 to 9 (width to height 74 to 80 %), the face in the middle (45 to 55 %), the eyes 30
// to 50 % below the upper edge, the head 50 to 75 % of the width and 60 to 90 % of the height, at least 90
// pixels between the eyes, the camera 0.7 to 4 m away. Ours: 840 x 1080 pixels of 0.3 mm in the plane of the
// eyes (252 x 324 mm), eyes in the middle at 45 %, seen from 1.5 m; 62 mm between the eyes are 207 pixels, a
// head 150 mm wide and 225 mm high takes 60 % and 69 %. An eye's middle is half way between its corners (one
// that was not found is taken from the other side, mirrored); where both inner or both outer ones are missing
// the eyes' line is a typical face's, some millimetres off. The head stands upright and looks straight ahead,
// however the person stood. Background: an even light grey. The standards are not public. Checked against a
// vendor's reference (id3 Face SDK, GeometricAttributes and PortraitProcessor, "for ICAO compliance"): head
// width 50 to 75, head height 60 to 90, eyes 30 to 50 below the upper edge. 90 pixels between the eyes:
// photogov.app on ICAO 9303. No source was found for 74 to 80 %, 45 to 55 % and 0.7 to 4 m. Throws
// std::bad_alloc. Thread: any.
Portrait draw_portrait(const FaceModel& model, std::pmr::memory_resource* output,
                       std::pmr::memory_resource* scratch);

// A textured model seen by a pinhole camera, drawn in software: nearest surface in front, texture between its
// texels, four samples a pixel. Triangles are far smaller than their distance, so the texture is interpolated
// affinely across them (error below a tenth of a texel). Throws std::bad_alloc. Thread: any.
struct ViewCamera {
  RigidTransform view_from_camera;  // from the left camera's frame; x right, y down, z away from this camera
  double focal_px = 0;
  Vec2d centre_px;
  int width_px = 0;
  int height_px = 0;
  std::array<std::uint8_t, 3> background{200, 200, 200};
};

struct TexturedView {
  explicit TexturedView(std::pmr::memory_resource* memory) : rgb(memory), shows(memory) {}
  std::pmr::vector<std::uint8_t> rgb;    // 3 a pixel
  std::pmr::vector<std::uint8_t> shows;  // as in recognition_images.h, of most of the pixel
};

TexturedView draw_textured(const FaceMesh& mesh, const TextureAtlas& atlas, const ViewCamera& camera,
                           std::pmr::memory_resource* output, std::pmr::memory_resource* scratch);

Result<RecognitionImages> make_recognition_images(const FaceModel& model, std::pmr::memory_resource& output,
                                                  std::pmr::memory_resource& scratch);

}  // namespace relievo::pipeline
