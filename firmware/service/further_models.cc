// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/further_models.h"

#include <cstdio>
#include <memory_resource>

#include "firmware/base/boot_memory.h"
#include "firmware/base/budget.h"
#include "firmware/base/version.h"
#include "firmware/jobs/job_thread.h"
#include "hal/base/arena.h"
#include "hal/base/thread_pool.h"
#include "pipeline/algorithms.h"
#include "pipeline/mesh/completion/solid_head.h"
#include "pipeline/mesh/detail/level_of_detail.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {

namespace {

Result<void> write_files(const pipeline::FaceModel& model, std::string_view stem,
                         const std::filesystem::path& folder, storage::ExportFrame frame,
                         const std::filesystem::path& place) {
  storage::ExportOptions options(frame);
  options.version = kVersion;
  options.stem = stem;
  const auto files = storage::write_model_files(model, folder, options);
  return files ? Result<void>() : files.error().at(place.string());
}

Result<std::string> write_light(const pipeline::FaceModel& model, int triangles,
                                const std::filesystem::path& folder, storage::ExportFrame frame,
                                const std::filesystem::path& place) {
  std::pmr::monotonic_buffer_resource memory;
  pipeline::DetailOptions options;
  options.triangles = triangles;
  RELIEVO_TRY_ASSIGN(const pipeline::LighterModel light, pipeline::lighten(model, options, &memory));
  RELIEVO_TRY(write_files(light.model, "light", folder, frame, place));
  std::error_code unknown;
  const auto glb_bytes = std::filesystem::file_size(folder / "light.glb", unknown);
  char line[160];
  std::snprintf(line, sizeof line,
                "light: %zu triangles, %ju bytes as GLB, off the model by %.3f mm rms, %.3f mm at most",
                light.model.mesh.triangles.size(), static_cast<std::uintmax_t>(glb_bytes), light.rms_error_mm,
                light.max_error_mm);
  return std::string(line);
}

Result<std::string> write_solid(const pipeline::FaceModel& model, const std::filesystem::path& folder,
                                storage::ExportFrame frame, const std::filesystem::path& place,
                                const std::atomic<bool>& cancelled) {
  // Of its own, since a visit's may still be on the page. The kernel clears what is given back.
  const BootMemory memory(0, budget::kSolidProductBytes, budget::kSolidScratchBytes);
  Arena output(memory.output()), scratch(memory.scratch());
  ThreadPool pool(pool_size());
  pipeline::Progress progress;
  pipeline::StageContext context{output, scratch, pool, progress, cancelled};
  pipeline::AlgorithmSet set;
  RELIEVO_TRY(set.set("completion", "generic-head"));
  RELIEVO_TRY_ASSIGN(const auto algorithms, pipeline::make_algorithms(set));
  auto mesh = pipeline::make_solid(model, algorithms.completion, context);
  // The model is no worse for it.
  if (!mesh && (mesh.error().code == Errc::PoorGeometry || mesh.error().code == Errc::OutOfMemory))
    return "no solid: " + std::string(mesh.error().what.view());
  if (!mesh) return mesh.error().at(place.string());
  pipeline::FaceModel solid(&output);
  solid.mesh = *std::move(mesh);
  solid.landmarks = model.landmarks;
  solid.head_from_camera = model.head_from_camera;
  const std::size_t triangles = solid.mesh.triangles.size();
  RELIEVO_TRY(write_files(solid, "solid", folder, frame, place));
  return "solid: " + std::to_string(triangles) + " triangles, closed, cut flat at the neck";
}

}  // namespace

Result<std::vector<std::string>> write_further_models(
    const pipeline::FaceModel& model, const FurtherModels& wanted, const std::filesystem::path& folder,
    storage::ExportFrame frame, const std::filesystem::path& place, const std::atomic<bool>& cancelled) {
  std::vector<std::string> lines;
  if (wanted.lod > 0) {
    RELIEVO_TRY_ASSIGN(std::string line, write_light(model, wanted.lod, folder, frame, place));
    lines.push_back(std::move(line));
  }
  if (wanted.watertight) {
    RELIEVO_TRY_ASSIGN(std::string line, write_solid(model, folder, frame, place, cancelled));
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace relievo::firmware
