// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/records/disk_room.h"

namespace relievo::firmware {

Result<void> disk_has_room(const std::filesystem::path& folder, std::int32_t least_mib) {
  std::error_code none;
  const auto room = std::filesystem::space(folder, none);
  if (none) return Error{Errc::IoFailed, "the disk does not tell how much room it has"};
  if (room.available >> 20 < static_cast<std::uintmax_t>(least_mib))
    return Error{Errc::MediaFull, "less room is left on the disk than is to stay free: make room"};
  return {};
}

}  // namespace relievo::firmware
