// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/sheet/sheet_photo.h"

#include <system_error>

namespace relievo::hal::sim {

Result<void> photograph_sheet(const Picture& picture, const SheetPhotoOptions& options,
                              const std::filesystem::path& folder) {
  RELIEVO_TRY(options.rig.check());
  RELIEVO_TRY_ASSIGN(const auto scene, make_sheet_scene(picture, options.sheet));
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{Errc::IoFailed, "cannot make this folder", failed.value()}.at(folder.native());
  ThreadPool pool(options.threads);
  const SimRig rig = make_rig(options.rig);
  RELIEVO_TRY(write_rig(folder / "rig.yml", rig));
  const PicturePair pair = render_pair(*scene, rig, options.sensor, options.seed * 1000ULL, pool);
  RELIEVO_TRY(write_picture(folder / "left.png", pair.left.view()));
  return write_picture(folder / "right.png", pair.right.view());
}

}  // namespace relievo::hal::sim
