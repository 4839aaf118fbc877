// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/invitation_head.h"

#include <cstring>
#include <fstream>
#include <vector>

#include "hal/base/shared_files.h"
#include "hal/picture_file.h"
#include "storage/model_blob.h"

namespace relievo::firmware {
Result<std::unique_ptr<InvitationHead>> InvitationHead::read(const std::filesystem::path& folder) {
  auto piece = std::make_unique<InvitationHead>();
  std::ifstream in(folder / kInvitationHeadMesh, std::ios::binary);
  if (!in)
    return Error{Errc::NotFound, "is not there: the page that invites shows no head"}.at(
        (folder / kInvitationHeadMesh).string());
  const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
  RELIEVO_TRY_ASSIGN(auto model, storage::decode_model(std::as_bytes(std::span(bytes)), &piece->memory_));
  RELIEVO_TRY_ASSIGN(const hal::Picture skin, hal::read_picture(folder / kInvitationHeadTexture));
  if (skin.format != PixelFormat::Rgb8)
    return invalid("is no colour picture").at((folder / kInvitationHeadTexture).string());
  model.texture.width_px = skin.width_px;
  model.texture.height_px = skin.height_px;
  model.texture.rgb.resize(skin.bytes.size());
  std::memcpy(model.texture.rgb.data(), skin.bytes.data(), skin.bytes.size());
  piece->model_.emplace(std::move(model));
  return piece;
}

std::filesystem::path asset_folder() {
  return shared_files("RELIEVO_ASSET_DIR", "assets", RELIEVO_ASSET_DIR);
}

}  // namespace relievo::firmware
