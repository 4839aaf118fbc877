// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/command/light_model.h"

#include <cstdio>
#include <memory_resource>

#include "firmware/base/version.h"
#include "pipeline/mesh/detail/level_of_detail.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {

Result<std::string> write_light_model(const pipeline::FaceModel& model, int triangles,
                                      const std::filesystem::path& folder, storage::ExportFrame frame,
                                      const std::filesystem::path& place) {
  std::pmr::monotonic_buffer_resource memory;
  pipeline::DetailOptions options;
  options.triangles = triangles;
  RELIEVO_TRY_ASSIGN(const pipeline::LighterModel light, pipeline::lighten(model, options, &memory));
  storage::ExportOptions files_options(frame);
  files_options.version = kVersion;
  files_options.stem = "light";
  const auto files = storage::write_model_files(light.model, folder, files_options);
  if (!files) return files.error().at(place.string());
  std::error_code unknown;
  const auto glb_bytes = std::filesystem::file_size(folder / "light.glb", unknown);
  char line[160];
  std::snprintf(line, sizeof line,
                "light: %zu triangles, %ju bytes as GLB, off the model by %.3f mm rms, %.3f mm at most",
                light.model.mesh.triangles.size(), static_cast<std::uintmax_t>(glb_bytes), light.rms_error_mm,
                light.max_error_mm);
  return std::string(line);
}

}  // namespace relievo::firmware
