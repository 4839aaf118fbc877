// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// InvitationHead: the head on the page that invites. A simulated person, photographed by the simulated rig
// and measured as every visitor is: it promises nothing that a visitor's own does not keep. Two files: the
// mesh as the store keeps models, with a texture of one texel, and the texture as a JPEG. Errors: NotFound,
// StoreCorrupt, those of the picture file. Thread: main.
#pragma once

#include <filesystem>
#include <memory>
#include <memory_resource>
#include <optional>

#include "hal/base/result.h"
#include "pipeline/model/face_model.h"

namespace relievo::firmware {

inline constexpr const char *kInvitationHeadMesh = "invitation_head.face",
                            *kInvitationHeadTexture = "invitation_head.jpg";

class InvitationHead {
 public:
  static Result<std::unique_ptr<InvitationHead>> read(const std::filesystem::path& folder);
  const pipeline::FaceModel& model() const { return *model_; }

 private:
  std::pmr::monotonic_buffer_resource memory_;
  std::optional<pipeline::FaceModel> model_;
};

// Where its files lie: shared_files() of $RELIEVO_ASSET_DIR.
std::filesystem::path asset_folder();

}  // namespace relievo::firmware
