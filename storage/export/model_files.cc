// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/model_files.h"

#include <algorithm>
#include <cerrno>
#include <functional>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "storage/byte_order.h"
#include "storage/export/atomic_file.h"
#include "storage/export/format/glb_writer.h"
#include "storage/export/format/obj_writer.h"
#include "storage/export/format/ply_writer.h"
#include "storage/export/format/png_writer.h"
#include "storage/export/format/stl_writer.h"
#include "storage/export/recognition_files.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

Result<void> make_directory(const fs::path& dir) {
  std::error_code failed;
  fs::create_directories(dir, failed);
  if (fs::is_directory(dir, failed)) return {};
  const bool full = failed.value() == ENOSPC || failed.value() == EDQUOT;
  return Error{full ? Errc::MediaFull : Errc::IoFailed,
               "this directory cannot be made: check the path, its permissions and the room on the disk",
               failed.value()}
      .at(dir.string());
}

class Batch {
 public:
  explicit Batch(const fs::path& dir) : dir_(dir) {}

  Result<void> add(std::string_view name, std::span<const std::byte> bytes) {
    RELIEVO_TRY_ASSIGN(auto file, PendingFile::create(dir_ / name));
    RELIEVO_TRY(file.write(bytes));
    RELIEVO_TRY(file.finish());
    files_.push_back(std::move(file));
    return {};
  }

  // A file is renamed only after those it names.
  Result<std::vector<fs::path>> publish() {
    std::vector<fs::path> written;
    for (auto& file : files_) written.push_back(file.target());
    for (auto& file : files_) RELIEVO_TRY(file.publish());
    RELIEVO_TRY(sync_directory(dir_));
    return written;
  }

 private:
  const fs::path& dir_;
  std::vector<PendingFile> files_;
};

Result<std::vector<std::byte>> origin_png(const pipeline::TextureAtlas& texture) {
  std::vector<std::uint8_t> grey(texture.origin.size());
  std::ranges::transform(texture.origin, grey.begin(), [](std::uint8_t o) {
    return o >= pipeline::kLeftPhotographTexel ? std::uint8_t{255}
           : o == pipeline::kFilledTexel       ? std::uint8_t{128}
                                               : std::uint8_t{0};
  });
  return png_of_grey(texture.width_px, texture.height_px, grey);
}

// Each file once it is made, so that one at a time lies in memory.
using Take = std::function<Result<void>(const std::string& name, std::span<const std::byte> bytes)>;

Result<void> make_all(const pipeline::FaceModel& model, const ExportOptions& options, const Take& take) {
  RELIEVO_TRY_ASSIGN(ExportMesh mesh, make_export_mesh(model, options.frame));
  mesh.version = options.version;
  const auto name = [&options](const char* ending) { return std::string(options.stem) + ending; };
  RELIEVO_TRY(take(name(".ply"), ply_bytes(mesh)));
  RELIEVO_TRY(take(name(".stl"), stl_bytes(mesh)));
  std::vector<std::byte> png;
  if (mesh.textured()) {
    RELIEVO_TRY_ASSIGN(png, png_bytes(model.texture));
    RELIEVO_TRY(take(name(".png"), png));
    if (!model.texture.origin.empty()) {
      RELIEVO_TRY_ASSIGN(const auto origin, origin_png(model.texture));
      RELIEVO_TRY(take(name("_origin.png"), origin));
    }
  }
  RELIEVO_TRY(take(name(".mtl"), bytes_of(mtl_text(mesh, name(".png")))));
  RELIEVO_TRY(take(name(".obj"), bytes_of(obj_text(mesh, name(".mtl")))));
  RELIEVO_TRY(take(name(".glb"), glb_bytes(mesh, png)));
  if (options.images == nullptr) return {};
  RELIEVO_TRY_ASSIGN(const auto files, recognition_files(*options.images, model.landmarks,
                                                         model.head_from_camera, options.version));
  for (const NamedBytes& file : files) RELIEVO_TRY(take(file.name, file.bytes));
  return {};
}

Result<std::vector<fs::path>> write_all(const pipeline::FaceModel& model, const fs::path& dir,
                                        const ExportOptions& options) {
  Batch batch(dir);
  const Take write = [&](const std::string& name, std::span<const std::byte> bytes) -> Result<void> {
    RELIEVO_TRY(make_directory(dir));  // not for a model that cannot be written
    return batch.add(name, bytes);
  };
  RELIEVO_TRY(make_all(model, options, write));
  return batch.publish();
}

}  // namespace

Result<std::vector<fs::path>> write_model_files(const pipeline::FaceModel& model, const fs::path& dir,
                                                const ExportOptions& options) {
  try {
    return write_all(model, dir, options);
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory to write the model; nothing was written"};
  }
}

Result<std::vector<BundleFile>> make_model_files(const pipeline::FaceModel& model,
                                                 const ExportOptions& options) {
  std::vector<BundleFile> files;
  const Take keep = [&](const std::string& name, std::span<const std::byte> bytes) {
    files.push_back({name, {bytes.begin(), bytes.end()}});
    return Result<void>();
  };
  RELIEVO_TRY(make_all(model, options, keep));
  return files;
}

}  // namespace relievo::storage
