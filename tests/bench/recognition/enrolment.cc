// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/enrolment.h"

#include "pipeline/mesh/landmarks/head_frame.h"
#include "tests/bench/frame_trial.h"

namespace relievo::bench {

Result<SeenSurface> surface_of(const std::filesystem::path& folder, test::StageFixture& room) {
  const std::filesystem::path file = folder / "mesh.bin";
  room.output.reset();
  if (std::filesystem::exists(file)) return read_surface(file, &room.output);
  SeenSurface surface(&room.output);
  RELIEVO_TRY_ASSIGN(surface.mesh, reconstruct_folder(folder, room, surface.across));
  RELIEVO_TRY(write_surface(file, surface));
  return surface;
}

Result<pipeline::ComparableFace> enrol(const std::filesystem::path& folder, test::StageFixture& room) {
  RELIEVO_TRY_ASSIGN(const SeenSurface surface, surface_of(folder, room));
  const auto frame = pipeline::run_stage(room.context, [&](pipeline::StageContext& c) {
    return find_head_frame(surface.mesh, c, surface.across);
  });
  if (!frame) return frame.error();
  std::pmr::memory_resource* const heap = std::pmr::new_delete_resource();
  return pipeline::ComparableFace::make(
      pipeline::rigid_face_of(surface.mesh, frame->head_from_camera, heap, heap));
}

}  // namespace relievo::bench
