// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The portrait and the range image as files, with a page of numbers that explains them:
//   portrait.png        8 bit RGB, sRGB              range.png        16 bit grey: z_mm = (value - 32768) /
//   100, 0 nothing portrait_shows.png  what a pixel shows           range_sigma.png  16 bit grey: sigma along
//   z in mm = value / 1000
//                                                    range_shows.png  what a pixel shows
//   recognition.json    units, axes, where the pixels lie; the landmarks in millimetres and in the portrait
// shows: 0 nothing, 128 surface that was completed, 255 surface that was measured.
// Errors: those of PNG. May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/landmarks.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::storage {

struct NamedBytes {
  const char* name;
  std::vector<std::byte> bytes;
};

// The JSON last: it names the others.
Result<std::vector<NamedBytes>> recognition_files(const pipeline::RecognitionImages& images,
                                                  const pipeline::Landmarks& landmarks,
                                                  const pipeline::RigidTransform& head_from_camera,
                                                  std::string_view version);

}  // namespace relievo::storage
