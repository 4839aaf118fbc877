// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files a face model is handed out in: model.ply, model.obj + .mtl + .png, model.stl, model.glb, and
// model_origin.png: what the texture's texels are (0 no surface, 128 filled, 255 photographed). With
// images, those for recognition programs too.
//
// One file's bytes are in memory at a time, beside the texture's, which two files carry: at most
// 100 bytes a triangle. All are written under temporary names and made durable first, then renamed: a failure
// while writing leaves the directory as it was, and an older model.* whole. Errors: InvalidInput (the model
// does not hang together); MediaFull; IoFailed; OutOfMemory. Thread: any; blocks on the disk (the keeper, not
// the screen).
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/landmarks.h"
#include "pipeline/model/recognition_images.h"
#include "storage/export/bundle.h"
#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

// The portrait and the range image as files, with a page of numbers that explains them:
//   portrait.png        8 bit RGB, sRGB
//   portrait_shows.png  what a pixel shows: 0 nothing, 128 surface that was completed, 255 that was measured
//   range.png           16 bit grey: z_mm = (value - 32768) / 100, 0 nothing
//   range_sigma.png     16 bit grey: sigma along z in mm = value / 1000
//   range_shows.png     as portrait_shows.png
//   recognition.json    units, axes, where the pixels lie; the landmarks in millimetres and in the portrait
// Errors: those of PNG. May throw std::bad_alloc. Thread: any.
// The JSON comes last: it names the others.
Result<std::vector<BundleFile>> recognition_files(const pipeline::RecognitionImages& images,
                                                  const pipeline::Landmarks& landmarks,
                                                  const pipeline::RigidTransform& head_from_camera,
                                                  std::string_view version);

struct ExportOptions {
  // A frame says it all, mostly. NOLINTNEXTLINE(google-explicit-constructor)
  ExportOptions(ExportFrame in_frame) : frame(in_frame) {}
  ExportFrame frame;
  std::string_view version{};                           // of the program
  const pipeline::RecognitionImages* images = nullptr;  // always in the head frame
  std::string_view stem = "model";  // of the files' names: another for a lighter model beside it
};

// Makes the directory if there is none. Returns the files written, in the order ply, stl, png, origin,
// mtl, obj, glb, images; without a texture there is no png.
Result<std::vector<std::filesystem::path>> write_model_files(const pipeline::FaceModel& model,
                                                             const std::filesystem::path& dir,
                                                             const ExportOptions& options);
// The same in memory, for who may leave nothing unsealed on a disk. May throw std::bad_alloc.
Result<std::vector<BundleFile>> make_model_files(const pipeline::FaceModel& model,
                                                 const ExportOptions& options);

}  // namespace relievo::storage
