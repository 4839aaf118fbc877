// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Showpiece: the head on the page that invites. A simulated person, photographed by the simulated rig
// and measured by this product, completed where no camera saw it and cut to an oval; nobody real. Two files: the mesh as the store keeps models, with a
// texture of one texel, and the texture as a JPEG.
// Errors: NotFound, StoreCorrupt, those of the picture file. Thread: main.
#pragma once

#include <filesystem>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"

namespace relievo::firmware {

class Showpiece {
 public:
  static Result<std::unique_ptr<Showpiece>> read(const std::filesystem::path& folder);
  // What a face is reconstructed with for it, as --set has it: a smooth surface, completed by the usual head.
  static std::vector<std::string> algorithms();
  // Writes a lighter form of a model, whole and cut to an oval (showpiece_finish.h); the folder must exist.
  static Result<void> write(const pipeline::FaceModel& model, const std::filesystem::path& folder);
  const pipeline::FaceModel& model() const { return *model_; }

 private:
  std::pmr::monotonic_buffer_resource memory_;
  std::optional<pipeline::FaceModel> model_;
};

// $RELIEVO_ASSET_DIR, or where the build put it.
std::filesystem::path asset_folder();

}  // namespace relievo::firmware
