// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/model_files.h"

#include <cerrno>
#include <new>
#include <string_view>
#include <system_error>

#include "storage/byte_order.h"
#include "storage/export/atomic_file.h"
#include "storage/export/glb_writer.h"
#include "storage/export/obj_writer.h"
#include "storage/export/ply_writer.h"
#include "storage/export/png_writer.h"

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

Result<std::vector<fs::path>> write_all(const pipeline::FaceModel& model, const fs::path& dir,
                                        ExportFrame frame) {
  RELIEVO_TRY_ASSIGN(const ExportMesh mesh, make_export_mesh(model, frame));
  RELIEVO_TRY(make_directory(dir));
  Batch batch(dir);
  RELIEVO_TRY(batch.add("model.ply", ply_bytes(mesh)));
  std::vector<std::byte> png;
  if (mesh.textured()) {
    RELIEVO_TRY_ASSIGN(png, png_bytes(model.texture));
    RELIEVO_TRY(batch.add("model.png", png));
  }
  RELIEVO_TRY(batch.add("model.mtl", bytes_of(mtl_text(mesh, "model.png"))));
  RELIEVO_TRY(batch.add("model.obj", bytes_of(obj_text(mesh, "model.mtl"))));
  RELIEVO_TRY(batch.add("model.glb", glb_bytes(mesh, png)));
  return batch.publish();
}

}  // namespace

Result<std::vector<fs::path>> write_model_files(const pipeline::FaceModel& model, const fs::path& dir,
                                                ExportFrame frame) {
  try {
    return write_all(model, dir, frame);
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory to write the model; nothing was written"};
  }
}

}  // namespace relievo::storage
