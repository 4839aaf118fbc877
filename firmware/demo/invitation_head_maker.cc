// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/demo/invitation_head_maker.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "firmware/kiosk/invitation_head.h"
#include "hal/picture_file.h"
#include "pipeline/mesh/detail/level_of_detail.h"
#include "storage/model_blob.h"

namespace relievo::firmware {
namespace {

constexpr int kTriangles = 9000;  // seen from across a room
constexpr int kTexturePx = 768;
constexpr int kJpegPercent = 88;

hal::Picture smaller(const pipeline::TextureAtlas& atlas) {
  hal::Picture picture;
  const int step = std::max(1, std::max(atlas.width_px, atlas.height_px) / kTexturePx);
  picture.width_px = atlas.width_px / step;
  picture.height_px = atlas.height_px / step;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int k = 0; k < step * step; ++k)
          sum += atlas.rgb[3 * (static_cast<std::size_t>(y * step + k / step) *
                                    static_cast<std::size_t>(atlas.width_px) +
                                static_cast<std::size_t>(x * step + k % step)) +
                           static_cast<std::size_t>(c)];
        picture.bytes.push_back(static_cast<std::byte>(sum / (step * step)));
      }
    }
  }
  return picture;
}

Result<void> write_bytes(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush())
    return Error{Errc::IoFailed, "cannot be written: is the folder there, and is there room?"}.at(
        file.string());
  return {};
}

}  // namespace

Result<void> make_invitation_head(const pipeline::FaceModel& model, const std::filesystem::path& folder) {
  std::pmr::monotonic_buffer_resource memory;
  pipeline::DetailOptions options;
  options.triangles = kTriangles;
  RELIEVO_TRY_ASSIGN(pipeline::LighterModel light, pipeline::lighten(model, options, &memory));
  const hal::Picture skin = smaller(light.model.texture);
  RELIEVO_TRY_ASSIGN(const auto jpeg, hal::encode_jpeg(skin.view(), kJpegPercent));
  pipeline::TextureAtlas& atlas = light.model.texture;
  atlas.width_px = atlas.height_px = 1;
  atlas.rgb.assign(3, 0);
  atlas.origin.clear();
  light.model.landmarks = {};
  RELIEVO_TRY_ASSIGN(const auto mesh, storage::encode_model(light.model));
  RELIEVO_TRY(write_bytes(folder / kInvitationHeadMesh, mesh));
  return write_bytes(folder / kInvitationHeadTexture, jpeg);
}

}  // namespace relievo::firmware
