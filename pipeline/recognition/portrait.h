// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
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
#pragma once

#include <memory_resource>

#include "pipeline/model/face_model.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::pipeline {

Portrait draw_portrait(const FaceModel& model, std::pmr::memory_resource* output,
                       std::pmr::memory_resource* scratch);

}  // namespace relievo::pipeline
